//! This file claims what a newcomer relies on: the folder of `new` works as its README says, pages and completions come out.

use crate::desk::Desk;

/// The commands that stand indented in a text.
fn commands(text: &str) -> Vec<&str> {
    let lines = text
        .lines()
        .filter_map(|line| line.strip_prefix("    rigproof "));
    lines.collect()
}

#[test]
fn the_three_commands_of_a_new_folder_find_what_its_readme_says_is_hidden() {
    let desk = Desk::new();
    desk.prints("new my-lab", 0);
    assert_eq!(
        desk.names("my-lab"),
        ["README.md", "recording.csv", "rig.schema.json", "rig.toml"]
    );
    let readme = desk.read("my-lab/README.md");
    let commands = commands(&readme);
    assert_eq!(commands.len(), 4, "{commands:?}");
    let lab = desk.path("my-lab");
    for command in &commands[..3] {
        let answer = desk.rigproof_in(&lab, command);
        assert_eq!(answer.status.code(), Some(0), "{command}: {answer:?}");
    }
    let report: serde_json::Value =
        serde_json::from_str(&desk.read("my-lab/recording-diagnosis/report.json")).unwrap();
    let effects = report["effects"].as_array().unwrap();
    assert!(!effects.is_empty());
    let (_, hidden) = readme.rsplit_once("hides ").unwrap();
    for effect in effects {
        let name = effect["mechanism"].as_str().unwrap();
        assert!(hidden.contains(&format!("`{name}`")), "{name}: {hidden}");
    }
    // Its last command begins a description of a recording.
    let own = commands[3].replace("yours", "recording");
    assert_eq!(desk.rigproof_in(&lab, &own).status.code(), Some(0));
}

#[test]
fn what_stands_in_a_folder_is_never_replaced() {
    let desk = Desk::new();
    desk.prints("new lab --plant bench", 0);
    let edited = desk.read("lab/rig.toml") + "# mine\n";
    desk.put("lab/rig.toml", &edited);
    for line in ["new lab --plant bench", "new lab", "demo --out lab"] {
        let answer = desk.rigproof(line);
        assert_eq!(answer.status.code(), Some(3), "{line}");
    }
    assert_eq!(desk.read("lab/rig.toml"), edited);
    assert_eq!(desk.names("."), ["lab"]);
}

#[test]
fn every_verb_has_a_manual_page_and_every_shell_its_completions() {
    let desk = Desk::new();
    desk.prints("man --out man1", 0);
    let pages = desk.names("man1");
    for page in [
        "rigproof.1",
        "rigproof-diagnose.1",
        "rigproof-blind-trial.1",
    ] {
        assert!(pages.iter().any(|name| name == page), "{page}: {pages:?}");
    }
    let page = desk.read("man1/rigproof-diagnose.1");
    assert!(
        page.contains("rigproof diagnose") && page.contains("hold\\-out"),
        "{page}"
    );
    let (_, synopsis) = page.split_once(".SH SYNOPSIS\n").unwrap();
    let synopsis = synopsis.lines().next().unwrap();
    assert_eq!(
        synopsis,
        "rigproof diagnose [OPTIONS] \\-\\-rig <TOML> <RECORDING> [MORE]..."
    );
    assert!(!pages.iter().any(|name| name.contains("host")));
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = desk.prints(&format!("completions {shell}"), 0);
        assert!(
            script.contains("diagnose") && script.contains("hold-out"),
            "{shell}"
        );
    }
}
