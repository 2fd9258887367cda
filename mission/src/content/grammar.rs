//! Comparing heard words with phrases.
//!
//! Problem: a recogniser writes "Option two." where the file has "option two", and writers of Spanish and French place
//! accents differently. Idea: compare words in lower case, without punctuation or accents. Invariant: an answer must be
//! everything that was heard, but a request may stand among other words: "the blue one" must not choose option one, and
//! "oh please help me" must call the clinician.

/// Words in normal form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Phrase(Vec<String>);

impl Phrase {
    pub(super) fn new(text: &str) -> Self {
        Self(normalise(text))
    }

    /// Whether exactly these words were heard.
    pub(super) fn is(&self, heard: &[String]) -> bool {
        !self.0.is_empty() && self.0 == heard
    }

    /// Whether these words were heard among others.
    pub(super) fn is_within(&self, heard: &[String]) -> bool {
        !self.0.is_empty() && heard.windows(self.0.len()).any(|w| w == self.0)
    }
}

/// Lower-case words without punctuation or accents.
pub(super) fn normalise(text: &str) -> Vec<String> {
    text.split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(|word| word.chars().flat_map(char::to_lowercase).map(without_accent).collect())
        .collect()
}

/// The plain letter of the accented ones that our languages use.
fn without_accent(c: char) -> char {
    match c {
        'á' | 'à' | 'â' | 'ä' => 'a',
        'é' | 'è' | 'ê' | 'ë' => 'e',
        'í' | 'ì' | 'î' | 'ï' => 'i',
        'ó' | 'ò' | 'ô' | 'ö' => 'o',
        'ú' | 'ù' | 'û' | 'ü' => 'u',
        'ñ' => 'n',
        'ç' => 'c',
        c => c,
    }
}

#[cfg(test)]
mod tests {
    use super::{Phrase, normalise};

    #[test]
    fn an_answer_is_everything_that_was_heard() {
        let one = Phrase::new("one");
        assert!(one.is(&normalise("One.")));
        assert!(!one.is(&normalise("the blue one")));
        assert!(!Phrase::new("").is(&normalise("")));
    }

    #[test]
    fn a_request_is_spotted_among_words() {
        let help = Phrase::new("ayúdeme");
        assert!(help.is_within(&normalise("¡Por favor, AYUDEME!")));
        assert!(!help.is_within(&normalise("ayuda")));
    }
}
