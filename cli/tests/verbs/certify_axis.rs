//! This file holds that a controller of an axis is certified, signed and checked from the command line, and that bad input is told.
#![cfg(target_os = "linux")]

use std::path::Path;

use super::controller::{ROOM, compiled};
use super::desk::Desk;

/// The example on a desk, and its library; nothing without a C compiler.
fn laid_out(desk: &Desk) -> Option<()> {
    for name in ["axis.toml", "slide.toml"] {
        let text = std::fs::read_to_string(Path::new(ROOM).join(name)).unwrap();
        desk.put(name, &text.replace("[regressions]\nerror = 0\n", ""));
    }
    compiled(&Path::new(ROOM).join("examples/pd.c"), &desk.path("pd.so"))
}

#[test]
fn a_controller_of_an_axis_is_certified_signed_and_checked() {
    let desk = Desk::new();
    if laid_out(&desk).is_none() {
        return;
    }
    let run = "certify axis.toml --controller pd.so --scenarios 8 --seconds 1";
    let text = desk.prints(run, 0);
    assert!(
        text.starts_with("May go on the rig: no law was broken in 8 trials"),
        "{text}"
    );
    let page = std::fs::read_to_string(desk.path("certified/certificate.html")).unwrap();
    assert!(page.contains("may go on the rig, as far as 8 simulated trials can say"));
    desk.prints("certify key lab.pem", 0);
    let file = "certified/certificate.json";
    desk.prints(
        &format!("certify sign {file} --key lab.pem --controller pd.so"),
        0,
    );
    let check = format!("certify --check {file} --controller pd.so --public-key lab.pem.pub");
    let answer = desk.json(&format!("{check} --json"), 0);
    assert_eq!(
        (&answer["signature"], &answer["holds"]),
        (&"holds".into(), &true.into())
    );
    assert_eq!(answer["run_again"], 8);
    // A changed byte is refused, and so is what belongs to a five-bar.
    let kept = std::fs::read_to_string(desk.path(file)).unwrap();
    desk.put(
        file,
        &kept.replacen("\"broken_in\": 0", "\"broken_in\": 1", 1),
    );
    assert_eq!(desk.rigproof(&check).status.code(), Some(3));
    for (line, part) in [
        (
            format!("{run} --search 3"),
            "--search is of a five-bar's campaign",
        ),
        (
            format!("{check} --sample 3"),
            "checked by all of its trials",
        ),
        (
            "certify axis.toml --scenarios 8".to_owned(),
            "add a table [controller] with `library`",
        ),
    ] {
        let answer = desk.rigproof(&line);
        let message = String::from_utf8(answer.stderr).unwrap();
        assert!(message.contains(part), "{message}");
        assert!([Some(2), Some(3)].contains(&answer.status.code()));
    }
}

#[test]
fn a_damper_of_the_wrong_sign_is_code_1_and_a_five_bar_s_controller_is_code_3() {
    let desk = Desk::new();
    if laid_out(&desk).is_none() {
        return;
    }
    let source = std::fs::read_to_string(Path::new(ROOM).join("examples/pd.c")).unwrap();
    let wrong = source.replace("+ damper * slower", "- 0.2 * damper * slower");
    assert!(wrong != source);
    desk.put("wrong.c", &wrong);
    compiled(&desk.path("wrong.c"), &desk.path("wrong.so")).unwrap();
    let run = "certify axis.toml --scenarios 8 --seconds 1 --controller";
    let text = desk.prints(&format!("{run} wrong.so"), 1);
    assert!(text.starts_with("Must NOT go on the rig:"), "{text}");
    assert!(text.contains("the law passivity is broken in"), "{text}");
    compiled(
        &Path::new(ROOM).join("examples/damper.c"),
        &desk.path("damper.so"),
    )
    .unwrap();
    let answer = desk.rigproof(&format!("{run} damper.so"));
    let message = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(3));
    assert!(
        message.contains("damper.so") && message.contains("of the five-bar"),
        "{message}"
    );
}
