//! What was heard, compared with what may be said.
//!
//! Problem: a recogniser writes "Option two." where the file says "option two", and Spanish and French
//! writers differ over accents. Idea: compare words in lower case, without punctuation or accents.
//! Invariant: an answer is the whole of what was heard; only requests are looked for inside it, because
//! "the blue one" must not choose option one, while "oh please help me" must call somebody.

/// Words in a comparable form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Phrase(Vec<String>);

impl Phrase {
    pub(super) fn new(text: &str) -> Self {
        Self(normalise(text))
    }

    /// Whether exactly this was heard.
    pub(super) fn is(&self, heard: &[String]) -> bool {
        !self.0.is_empty() && self.0 == heard
    }

    /// Whether this was heard among other words.
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
    fn an_answer_is_the_whole_of_what_was_heard() {
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
