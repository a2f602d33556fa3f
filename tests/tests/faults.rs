//! Whether what is wrong in a file is said by name, or mended and said: each kind of fault has three members at least, made of a sound recording by a few
//! lines, and the sound recording itself is called consistent.

mod channels;
mod clipping;
mod clocks;
mod continuity;
mod made;

use made::{Made, diagnosed};
use rigproof_diagnose::report::{Report, Verdict};

/// The fault of a recording, which must be in a channel, begin at a time (within a tenth of a second) and say a word.
fn assert_fault(made: &Made, channel: &str, from_s: Option<f64>, word: &str) {
    let report = diagnosed(made);
    assert_eq!(
        report.verdict,
        Verdict::DataFault,
        "{word}: {}",
        report.summary
    );
    let fault = report.fault.unwrap();
    assert_eq!(fault.channel, channel, "{}", fault.reason);
    assert!(fault.reason.contains(word), "{}", fault.reason);
    if let Some(from_s) = from_s {
        assert!(
            (fault.from_s - from_s).abs() < 0.1,
            "{} {}",
            fault.from_s,
            fault.reason
        );
    }
}

/// What is said of a recording that is consistent once it is mended.
fn assert_mended(made: &Made, channel: &str, what: &str) -> usize {
    let report = diagnosed(made);
    assert_consistent(&report);
    let remark = report
        .remarks
        .iter()
        .find(|own| own.what == what && own.channel == channel);
    remark
        .unwrap_or_else(|| panic!("{:?}", report.remarks))
        .count
}

fn assert_consistent(report: &Report) {
    let fault = report.fault.as_ref().map(|own| &own.reason);
    assert_eq!(
        report.verdict,
        Verdict::Consistent,
        "{} {fault:?}",
        report.summary
    );
}

#[test]
fn sound_recordings_are_consistent_and_nothing_is_said_of_them() {
    for made in [made::axis(), made::bench(), made::five_bar()] {
        let report = diagnosed(&made);
        assert_consistent(&report);
        assert!(report.remarks.is_empty(), "{:?}", report.remarks);
    }
}
