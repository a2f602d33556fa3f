//! Whatever comes out of a file is text on a page, never part of it.

use std::path::Path;

use rigproof_diagnose::report::{InputFile, Report, Verdict};
use rigproof_diagnose::{Curves, Description, Options};
use rigproof_report::diagnosis::{Diagnosed, page};
use rigproof_trace::{Channel, Trace};

const HOSTILE: &str = "</script><script>alert(1)</script><img src=x onerror=alert(1)>\"'&";

/// The report of a bench recording that is too short to tell anything.
fn report() -> Report {
    let text = "name = \"b\"\nplant = \"bench\"\nmotion = \"linear\"\n[channels]\nposition = { channel = \"x\", unit = \"m\", quantum = 1e-6 }\nforce = { channel = \"f\", unit = \"N\", noise = 0.02 }\n";
    let rig = Description::parse(text, Path::new("rig.toml")).unwrap();
    let channel = |name: &str, unit: &str, scale: f64| Channel {
        name: name.to_owned(),
        unit: unit.to_owned(),
        samples: (0..90).map(|k| scale * f64::from(k % 17)).collect(),
    };
    let trace = Trace {
        time_s: (0..90).map(|k| 1e-3 * f64::from(k)).collect(),
        channels: vec![channel("x", "m", 3e-4), channel("f", "N", 0.7)],
    };
    let recording = rig.apply(&trace, Path::new("run.csv")).unwrap();
    rig.diagnose(&[recording], None, &Options::default())
        .unwrap()
        .report
}

#[test]
fn a_name_that_is_a_script_stays_a_name() {
    let mut report = report();
    report.inputs.push(InputFile {
        path: HOSTILE.to_owned(),
        sha256: HOSTILE.to_owned(),
        read_as: None,
    });
    report.protocol.push(HOSTILE.to_owned());
    report.summary = HOSTILE.to_owned();
    let curves = Curves {
        unit: HOSTILE.to_owned(),
        residual_unit: HOSTILE.to_owned(),
        output: "effort",
        time_s: vec![0.5, 1.5, 2.5],
        recorded: vec![0.25, 0.75, 0.5],
        before: vec![0.25, 0.5, 0.75],
        after: vec![0.3, 0.7, 0.5],
        window_time_s: vec![0.5, 1.5, 2.5],
        window_counts: vec![true; 3],
        residual_before: vec![0.3, -0.2, 0.1],
        residual_after: vec![0.03, -0.02, 0.01],
        floor: 0.02,
        ..Curves::default()
    };
    for verdict in [
        Verdict::DataFault,
        Verdict::NotExcited,
        Verdict::Explained,
        Verdict::Consistent,
        Verdict::Ambiguous,
        Verdict::PartlyExplained,
        Verdict::NoneOfLibrary,
    ] {
        report.verdict = verdict;
        let html = page(Diagnosed {
            rig: HOSTILE,
            report: &report,
            curves: &curves,
            replay: None,
            next: Some(HOSTILE),
        });
        assert_eq!(html.matches("<script").count(), 2, "{verdict:?}");
        assert_eq!(html.matches("</script>").count(), 2);
        assert!(!html.contains("<img") && !html.contains("<script>alert"));
        assert!(html.contains("&lt;script&gt;alert(1)") && html.contains("\\u003cscript>alert(1)"));
        // Nothing is asked of anybody.
        assert!(html.contains("default-src 'none'") && !html.contains("src=\"http"));
    }
}

#[test]
fn a_minute_at_a_kilohertz_is_less_than_two_megabytes() {
    let report = report();
    let count = 60_000;
    let wave = |phase: f64| -> Vec<f64> {
        (0..count)
            .map(|k| libm::sin(7.3e-3 * f64::from(k) + phase) * 0.123_456_789)
            .collect()
    };
    let time_s: Vec<f64> = (0..count).map(|k| 1e-3 * f64::from(k)).collect();
    let curves = Curves {
        time_s: time_s.clone(),
        recorded: wave(0.0),
        before: wave(0.3),
        after: wave(0.1),
        window_time_s: time_s,
        window_counts: vec![true; 60_000],
        residual_before: wave(0.7),
        residual_after: wave(0.9),
        floor: 0.02,
        ..Curves::default()
    };
    let html = page(Diagnosed {
        rig: "rig",
        report: &report,
        curves: &curves,
        replay: None,
        next: None,
    });
    assert!(
        html.len() < 2_000_000 && html.len() > 300_000,
        "{} bytes",
        html.len()
    );
}
