//! This file holds what `rigproof cite` finds, and what it says where there is nothing.

use std::path::Path;

use crate::desk::Desk;

/// The repository that this test stands in.
fn repository() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    root.to_str().unwrap().to_owned()
}

/// Whether a file of the repository holds a text at a line.
fn holds(place: &serde_json::Value, text: &str) -> bool {
    let file = Path::new(&repository()).join(place["file"].as_str().unwrap());
    let line = place["line"].as_u64().unwrap() as usize;
    let source = std::fs::read_to_string(file).unwrap();
    source.lines().nth(line - 1).unwrap().contains(text)
}

#[test]
fn an_equation_is_cited_with_its_code_its_tests_and_its_errata() {
    let desk = Desk::new();
    let root = repository();
    let cited = desk.json(&format!("cite 4.4 --root {root} --json"), 0);
    assert_eq!(cited["number"], "4.4");
    assert!(holds(&cited, "| (4.4) |"));
    let code = cited["code"].as_array().unwrap();
    let obeyed = code.iter().find(|place| place["item"] == "base_jacobian");
    let obeyed = obeyed.unwrap_or_else(|| panic!("{cited}"));
    assert_eq!(obeyed["file"], "model/src/linkage/singularity.rs");
    assert!(holds(obeyed, "//= thesis (4.4)"));
    let tests = cited["tests"].as_array().unwrap();
    assert!(!tests.is_empty() && tests.iter().all(|place| holds(place, "(4.4) test")));
    let erratum = &cited["errata"][0];
    assert_eq!(erratum["id"], "j-theta");
    let at = erratum["at"].as_str().unwrap();
    assert!(at.starts_with("tests/tests/linkage/jacobian.rs:"), "{at}");

    let inside = format!("{root}/cli/src");
    let text = desk.prints(&format!("cite (5.24) --root {inside}"), 0);
    for words in [
        "(5.24)  λ4 by the law of cosines",
        "\nCode\n  model/src/linkage/",
        "\nTests\n",
        "`inverse-factor-two`, entered under (5.22)",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

#[test]
fn a_section_is_cited_with_its_code_its_tests_and_its_gaps() {
    let desk = Desk::new();
    let root = repository();
    let cited = desk.json(&format!("cite §2.2.2 --root {root} --json"), 0);
    assert!(holds(&cited, "| §2.2.2 |"));
    let code = cited["code"].as_array().unwrap();
    let obeyed = code.iter().find(|place| place["item"] == "Pter");
    assert!(
        holds(obeyed.unwrap(), "//= thesis section 2.2.2"),
        "{cited}"
    );
    let tests = cited["tests"].as_array().unwrap();
    assert!(!tests.is_empty() && tests.iter().all(|place| holds(place, "section 2.2.2 test")));
    let gaps = cited["gaps"].as_array().unwrap();
    assert!(
        gaps.iter().any(|gap| gap["id"] == "pter-control"),
        "{cited}"
    );
}

#[test]
fn an_unknown_number_is_answered_with_the_nearest_ones() {
    let desk = Desk::new();
    let answer = desk.rigproof(&format!("cite 5.99 --root {}", repository()));
    let message = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(2), "{message}");
    assert!(
        message.contains("no equation (5.99); the nearest are 5.68, 5.67, 5.66"),
        "{message}"
    );
}

#[test]
fn without_a_repository_it_says_where_to_look() {
    let desk = Desk::new();
    for line in ["cite 5.36", "cite 5.36 --root missing"] {
        let answer = desk.rigproof(line);
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(3), "{line}: {message}");
        assert!(
            message.contains("--root") && message.lines().count() == 1,
            "{message}"
        );
    }
}

#[test]
fn an_equation_that_nothing_stands_for_fails_the_check() {
    let desk = Desk::new();
    std::fs::create_dir_all(desk.path("spec/thesis")).unwrap();
    desk.put(
        "spec/thesis/equations.md",
        "| (7.1) | a = b | a, b |\n| (7.2) | c = d | c, d |\n",
    );
    desk.put("spec/thesis/sections.md", "| §7.1 | A title | – |\n");
    let erratum = "[[erratum]]\nid = \"x\"\nequation = \"7.1\"\nprinted = \"b = a\"\n";
    desk.put("spec/thesis/errata.toml", erratum);
    desk.put(
        "spec/thesis/gaps.toml",
        "[[gap]]\nid = \"y\"\nopen = \"what (7.2) is\"\n",
    );
    desk.put(
        "model.rs",
        "//= thesis (7.2)\npub fn c(d: f64) -> f64 { d }\n",
    );
    assert!(desk.prints("cite 7.1", 0).contains("Code\n  none"));
    let text = desk.prints("cite 7.2", 1);
    assert!(
        text.contains("  model.rs:1  c\n") && text.contains("`y`"),
        "{text}"
    );
}
