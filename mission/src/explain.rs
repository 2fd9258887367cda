//! The explanations of the codes of missions, a page each beside the code that reports it.

use std::sync::LazyLock;

use diagnostics::{Explanation, explained};

#[rustfmt::skip]
static EXPLANATIONS: LazyLock<Vec<Explanation>> = LazyLock::new(|| explained![
    "load": "E0706" "E0707" "E0708" "E0709" "E0710" "E0711" "E0712" "E0713";
    "content":
        "E0801" "E0802" "E0803" "E0804" "E0805" "E0806" "E0807" "E0808" "E0809" "E0810" "E0811" "E0812" "E0813";
    "scenario":
        "E0901" "E0902" "E0903" "E0904" "E0905" "E0906" "E0907" "E0908" "E0909" "E0910" "E0911";
    "check":
        "C0001" "C0101" "C0102" "C0201" "C0202" "C0203" "C0301" "C0302" "C0303" "C0304" "C0401" "C0402" "C0501"
        "C0502" "C0601" "C0701" "C0702" "C0801" "C0802" "C0803" "C0804" "C0901" "C0902";
]);

/// All explanations, in order of their codes.
pub fn explanations() -> impl Iterator<Item = &'static Explanation> {
    EXPLANATIONS.iter()
}
