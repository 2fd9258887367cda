//! Looking words up.

use mission::Mission;

use crate::tea;

#[test]
fn a_parts_own_sentence_precedes_the_general_one() {
    let mut files = tea::files();
    for language in ["en", "fr"] {
        let text = files.texts.get_mut(&format!("tea/content/{language}.toml")).unwrap();
        *text = text.replace("[part.drink.option]", "which = \"{name}?\"\n[part.drink.option]");
    }
    let mission = Mission::load(&files, "tea").unwrap();
    let own = mission.words("fr").unwrap().sentence("drink", "which").map(str::to_owned);
    let general = tea::mission().words("fr").unwrap().sentence("drink", "which").map(str::to_owned);
    assert_eq!(own.as_deref(), Some("thé?"));
    assert_eq!(general.as_deref(), Some("Quel thé désirez-vous ?"));
}

#[test]
fn templates_are_filled_in() {
    let mission = tea::mission();
    let words = mission.default_words();
    assert_eq!(words.sentence("drink", "green"), Some("Green tea, please."));
    assert_eq!(words.sentence("hello", "green"), None, "only the item offers it");
    assert_eq!(words.sentence("nowhere", "green"), None);
    assert_eq!(words.options("drink")[1].text, "Green tea");
    assert_eq!(words.options("hello").len(), 0);
    assert_eq!((words.tag(), words.language(), words.name("drink")), ("en", "English", Some("tea")));
}

#[test]
fn answers_are_whole_and_requests_are_spotted() {
    let mission = tea::mission();
    let words = mission.default_words();
    assert_eq!(words.understand("drink", "Green, TEA!").unwrap().as_str(), "green");
    assert_eq!(words.understand("drink", "the green one"), None);
    assert_eq!(words.spot("hey, Waiter, please").unwrap().as_str(), "help");
    assert_eq!(words.spot("waiters"), None);
    assert_eq!(words.request("help"), ["waiter"]);
}
