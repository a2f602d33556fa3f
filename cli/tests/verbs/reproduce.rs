//! This file holds what `rigproof reproduce` writes and prints.

use crate::desk::Desk;

#[test]
fn several_chapters_have_an_index_and_a_page_each() {
    let desk = Desk::new();
    desk.prints("reproduce 3.3 4.7 4.8 --html thesis.html", 0);
    let (index, fourth) = (desk.read("thesis.html"), desk.read("thesis-chapter-4.html"));
    for link in [
        "href=\"thesis-chapter-3.html\"",
        "href=\"thesis-chapter-4.html#experiment-4-8\"",
    ] {
        assert!(index.contains(link), "{link}");
    }
    // The index has no picture, a chapter its own alone, and the way back.
    assert!(!index.contains("data:image/svg+xml;base64,") && index.len() < 120_000);
    assert!(fourth.contains("id=\"experiment-4-7\"") && !fourth.contains("experiment-3-3"));
    assert!(fourth.contains("href=\"thesis.html\""));
}

#[test]
fn an_experiment_writes_its_tables_pictures_and_findings() {
    let desk = Desk::new();
    let printed = desk.prints("reproduce 3.3 --html thesis.html", 0);
    let page = desk.read("thesis.html");
    assert!(
        page.contains("statements of the text come out here")
            && page.contains("data:image/svg+xml;base64,")
    );
    assert!(printed.starts_with("3.3  Torque response"), "{printed}");
    assert!(
        printed.contains("agrees") && printed.contains("Together"),
        "{printed}"
    );
    let names = desk.names("rigproof-reproduced/3.3");
    assert_eq!(
        names,
        [
            "brake-a.csv",
            "brake-b.csv",
            "brake-c.csv",
            "brake-e.csv",
            "current-step.svg"
        ]
    );
    let run = rigproof_trace::csv::read(&desk.path("rigproof-reproduced/3.3/brake-b.csv")).unwrap();
    assert_eq!(run.channel("torque").unwrap().unit, "N·m");
    let picture = desk.read("rigproof-reproduced/3.3/current-step.svg");
    assert!(picture.contains("brake E") && !picture.contains("NaN"));
    assert!(picture.len() < 100_000, "{} bytes", picture.len());
    let findings = desk.read("rigproof-reproduced/findings.json");
    let findings: serde_json::Value = serde_json::from_str(&findings).unwrap();
    assert_eq!(findings[0]["id"], "3.3");
    assert_eq!(findings[0]["findings"][1]["stated"], "19 ms");
}

#[test]
fn the_experiments_are_listed_and_an_unknown_one_is_refused() {
    let desk = Desk::new();
    let list = desk.json("reproduce --json", 0);
    assert!(list.as_array().unwrap().len() >= 2, "{list}");
    let answer = desk.rigproof("reproduce 3.33");
    let message = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(2), "{message}");
    assert!(
        message.contains("`3.33` is no experiment; did you mean `3.3`?"),
        "{message}"
    );
    assert_eq!(desk.names("."), [""; 0]);
}

#[test]
fn a_place_that_holds_something_else_is_refused_before_the_work() {
    let desk = Desk::new();
    desk.put("brake", "mine");
    let answer = desk.rigproof("reproduce 3.3 --out brake");
    let message = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(3), "{message}");
    assert!(message.contains("name another folder"), "{message}");
    assert_eq!(desk.read("brake"), "mine");
}
