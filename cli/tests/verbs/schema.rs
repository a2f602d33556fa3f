//! This file claims that the schema of `certify.toml` and its reader take the same: a key more, a key less or one of another kind is refused by both.

use std::collections::BTreeSet;
use std::path::Path;

use rigproof_certify::description::Description;
use rigproof_certify::description::schema::{SCHEMA_LINE, schema_text};
use serde_json::{Value, json};

/// Descriptions with every table and every kind of key.
const EVERYTHING: [&str; 7] = [
    "name = \"a\"\nlayout = \"four_brake\"\nreference_every = 3\n[controller]\nkind = \"proportional\"\ngain_n_s_per_m = 412.5\nboundary_m = 0.047\nobstacle = \"left\"\n\
     [baseline]\nnamed = \"sdof_with_gap\"\nobstacle = \"right\"\n[limits]\npath_error_m = 0.011\ntip_force_n = 7.5\ndft_sum_m_s3 = 91.5\nswitching_per_s = 251\nfinish_s = 8.25\n\
     [regressions]\npath_error_m = 0.0015\nfinish_s = 0.75\n[expected]\nbrakes = \"A E\"\nmost_a = 0.31\nmost_share = 0.17\nsame_brakes = true\n\
     [path]\nkind = \"arc\"\ncentre_x_m = 0.01\ncentre_y_m = 0.33\nradius_m = 0.08\nfrom_rad = 0.1\nto_rad = 2.9\n",
    "[declares]\nmost_brakes = 3\nlocks = true\ngap_m = 0.0021\nboundary_m = 0.047\nchoice = \"quarter_turn\"\nwithin_force = true\nobstacle = \"right\"\n\
     [path]\nkind = \"spline\"\npoint = [{ x_m = 0.01, y_m = 0.31 }, { x_m = 0.05, y_m = 0.34 }, { x_m = 0.09, y_m = 0.29 }]\n",
    "[controller]\nkind = \"sdof\"\ngap_m = 0.0021\nboundary_m = 0.047\n[baseline]\nkind = \"uncontrolled\"\n",
    "[controller]\nkind = \"velocity_ratio\"\ngain_nm_s_per_rad = 1.7\nboundary_m = 0.047\n",
    "[controller]\nkind = \"optimal\"\nweight_angle = 0.7\nweight_energy = 0.3\nhorizon_s = 0.011\nboundary_m = 0.047\n",
    "[controller]\nkind = \"impedance\"\nstiffness_n_per_m = 310\ndamping_across_n_s_per_m = 11\ndamping_along_n_s_per_m = 3\n",
    include_str!("../../../certify/c/guarded.toml"),
];

/// A description with one thing spoilt: what was done, at which key, and the whole.
fn spoilt(whole: &Value) -> Vec<(&'static str, String, Value)> {
    let mut all = Vec::new();
    for place in tables(whole, String::new()) {
        let table = |whole: &mut Value| {
            whole
                .pointer_mut(&place)
                .unwrap()
                .as_object_mut()
                .unwrap()
                .clone()
        };
        let mut put = |how, key: &str, value: Option<Value>| {
            let mut changed = whole.clone();
            let own = changed
                .pointer_mut(&place)
                .unwrap()
                .as_object_mut()
                .unwrap();
            match value {
                Some(value) => drop(own.insert(key.to_owned(), value)),
                None => drop(own.remove(key)),
            }
            all.push((how, format!("{place}/{key}"), changed));
        };
        put("more", "zzz", Some(json!(1)));
        for (key, value) in table(&mut whole.clone()) {
            put("less", &key, None);
            let other = if value.is_boolean() {
                json!("yes")
            } else {
                json!(true)
            };
            put("other", &key, Some(other));
            if value.is_number() {
                put("beyond", &key, Some(json!(-1e15)));
            }
            if value.is_string() && key != "name" {
                put("word", &key, Some(json!("nobody's word")));
            }
        }
    }
    all
}

/// Where the tables are.
fn tables(value: &Value, at: String) -> Vec<String> {
    let inner: Vec<(String, &Value)> = match value {
        Value::Object(keys) => keys.iter().map(|(key, own)| (key.clone(), own)).collect(),
        Value::Array(items) => items
            .iter()
            .enumerate()
            .map(|(k, own)| (k.to_string(), own))
            .collect(),
        _ => Vec::new(),
    };
    let own = value.is_object().then(|| at.clone());
    let inner = inner
        .into_iter()
        .flat_map(|(key, own)| tables(own, format!("{at}/{key}")));
    own.into_iter().chain(inner).collect()
}

fn reader_says(keys: &Value) -> Option<String> {
    let text = toml::Table::try_from(keys).unwrap().to_string();
    let read = Description::parse(&text, Path::new("certify.toml"));
    read.err().map(|error| error.to_string())
}

#[test]
fn what_is_spoilt_in_a_certify_toml_is_refused_by_schema_and_reader() {
    let text = include_str!("../../../docs/certify.schema.json");
    let schema = serde_json::from_str(text).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let (mut refused, mut paths) = (0, BTreeSet::new());
    for text in EVERYTHING {
        let table: toml::Table = text.parse().unwrap();
        let whole = serde_json::to_value(&table).unwrap();
        assert_eq!(reader_says(&whole), None, "{text}");
        assert!(
            validator.is_valid(&whole),
            "{text}: {:?}",
            validator.validate(&whole)
        );
        for (how, place, changed) in spoilt(&whole) {
            let (passes, said) = (validator.is_valid(&changed), reader_says(&changed));
            // The reader knows more than shapes, such as which path comes of numbers.
            let is_more_than_shape = said
                .as_ref()
                .is_some_and(|said| said.contains("no path comes of it"));
            assert!(
                passes == said.is_none() || is_more_than_shape,
                "{how} {place}: the schema {}, the reader says {said:?}",
                if passes { "passes it" } else { "refuses it" }
            );
            refused += usize::from(!passes);
            paths.insert(place);
        }
    }
    assert!(
        refused > 150 && paths.len() > 60,
        "{refused} refused at {} keys",
        paths.len()
    );
}

#[test]
fn the_file_for_editors_is_what_the_types_say_and_every_description_names_it() {
    assert!(
        include_str!("../../../docs/certify.schema.json") == schema_text(),
        "docs/certify.schema.json is another: write it anew with `rigproof new FOLDER --plant rig`, which lays one down"
    );
    let (name, kept) = (SCHEMA_LINE, include_str!("../../../certify/example.toml"));
    assert_eq!(name, "#:schema certify.schema.json");
    assert!(kept.starts_with("#:schema ../docs/certify.schema.json\n"));
    for text in [
        include_str!("../../../certify/c/guarded.toml"),
        include_str!("../../../certify/c/damper.toml"),
    ] {
        assert!(text.starts_with("#:schema ../../docs/certify.schema.json\n"));
    }
}
