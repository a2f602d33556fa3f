//! This file claims that the schema that editors check descriptions by says what the reader takes.

use super::*;
use rigproof_spec::effect::Mechanism;

#[test]
fn the_file_for_editors_is_what_is_said_here() {
    let page = include_str!("../../../../docs/rig.schema.json");
    assert!(
        page == schema_text(),
        "docs/rig.schema.json is another: write it anew with `rigproof new FOLDER`, which lays one down"
    );
}

#[test]
fn every_mechanism_that_a_model_computes_has_a_case() {
    let whole = schema();
    assert_eq!(whole["oneOf"].as_array().unwrap().len(), 4);
    let computed = Mechanism::ALL.into_iter();
    let computed: Vec<&str> = computed
        .filter(|mechanism| !mechanism.parameters().is_empty())
        .map(Mechanism::name)
        .collect();
    let cases = whole["$defs"]["effect"]["oneOf"].as_array().unwrap();
    let named: Vec<&str> = cases
        .iter()
        .map(|case| case["properties"]["mechanism"]["const"].as_str().unwrap())
        .collect();
    assert_eq!(named, computed);
}
