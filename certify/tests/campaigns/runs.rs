//! This file says that a campaign comes out the same however it is run: on any threads, in parts, after being killed.

use std::fs;
use std::path::Path;

use rigproof_certify::built_in::BuiltIn;
use rigproof_certify::calibration::Calibration;
use rigproof_certify::campaign::{self, merge};
use rigproof_certify::certificate::Certificate;
use rigproof_certify::digest;
use rigproof_certify::journal::{Chunks, FILE, Header, Shard};
use rigproof_certify::law::Law;
use rigproof_certify::plan::{Plan, Subject};
use rigproof_certify::recheck::{Means, recheck};
use rigproof_certify::scenario::{Rig, Scenario};
use rigproof_certify::tool::Tool;
use rigproof_spec::methods::Method;
use rigproof_trace::rig::five_bar::FiveBar;

use crate::five::BOTH;

pub fn plan() -> Plan {
    let controller = Subject::built_in(BuiltIn::of(Method::SdofWithGap));
    Plan {
        baseline: Some(Subject::built_in(BuiltIn::of(Method::ProportionalLow))),
        seed: 23,
        scenarios: 44,
        ticks: 300,
        ..Plan::alone("a test", controller, BOTH.to_vec())
    }
}

pub fn tool() -> Tool {
    Tool {
        version: "0.1.0".to_owned(),
        sha256: "00".repeat(32),
    }
}

pub fn header(plan: &Plan, shard: Shard) -> Header {
    Header {
        plan: plan.clone(),
        shard,
        tool: tool(),
    }
}

pub fn run(plan: &Plan, shard: Shard, folder: &Path, threads: usize) -> Chunks {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    let sources = plan.sources().unwrap();
    let header = header(plan, shard);
    pool.install(|| campaign::run(&header, &sources, folder, &|_| ()))
        .unwrap()
}

pub fn certificate(plan: &Plan, chunks: &Chunks) -> String {
    Certificate::new(plan, chunks, Vec::new(), Vec::new(), tool())
        .unwrap()
        .to_json()
        .unwrap()
}

#[test]
fn one_thread_and_two_give_the_same_bytes() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let of = |threads: usize| {
        let chunks = run(
            &plan,
            [0, 1],
            &folder.path().join(threads.to_string()),
            threads,
        );
        certificate(&plan, &chunks)
    };
    assert_eq!(of(1), of(2));
}

#[test]
fn merged_parts_are_the_whole_bit_for_bit() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let whole = run(&plan, [0, 1], &folder.path().join("whole"), 2);
    let parts: Vec<_> = (0..3)
        .map(|part| folder.path().join(part.to_string()))
        .collect();
    for (part, folder) in (0..).zip(&parts) {
        run(&plan, [part, 3], folder, 2);
    }
    let (merged_plan, merged) = merge(&parts, &tool()).unwrap();
    assert_eq!(
        certificate(&merged_plan, &merged),
        certificate(&plan, &whole)
    );
    let missing = merge(&parts[..2], &tool()).unwrap_err().to_string();
    assert!(missing.contains("are missing"), "{missing}");
    let other = folder.path().join("other");
    run(&Plan { seed: 24, ..plan }, [2, 3], &other, 2);
    let mixed = merge(&[parts[0].clone(), parts[1].clone(), other], &tool()).unwrap_err();
    assert!(mixed.to_string().contains("plan differs"), "{mixed}");
    let newer = Tool {
        sha256: "11".repeat(32),
        ..tool()
    };
    let by_another = merge(&parts, &newer).unwrap_err().to_string();
    assert!(by_another.contains("another build"), "{by_another}");
}

#[test]
fn a_journal_that_ends_anywhere_goes_on_to_the_same_bytes() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let whole = run(&plan, [0, 1], &folder.path().join("whole"), 2);
    let expected = certificate(&plan, &whole);
    let journal = fs::read(folder.path().join("whole").join(FILE)).unwrap();
    for cut in [
        0,
        7,
        journal.len() / 3,
        journal.len() / 2,
        journal.len() - 1,
        journal.len(),
    ] {
        let killed = folder.path().join(format!("killed-{cut}"));
        fs::create_dir(&killed).unwrap();
        fs::write(killed.join(FILE), &journal[..cut]).unwrap();
        assert_eq!(
            certificate(&plan, &run(&plan, [0, 1], &killed, 2)),
            expected,
            "{cut}"
        );
    }
}

#[test]
fn a_folder_of_another_campaign_is_left_alone() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    run(
        &Plan {
            scenarios: 8,
            ..plan.clone()
        },
        [0, 1],
        folder.path(),
        2,
    );
    let before = fs::read(folder.path().join(FILE)).unwrap();
    let sources = plan.sources().unwrap();
    let whole = header(&plan, [0, 1]);
    let of_first = Plan {
        scenarios: 8,
        ..plan.clone()
    };
    let mut newer = header(&of_first, [0, 1]);
    newer.tool.sha256 = "11".repeat(32);
    let second = header(&of_first, [1, 2]);
    for (other, part) in [(whole, "plan"), (newer, "another build"), (second, "shard")] {
        let refused = campaign::run(&other, &sources, folder.path(), &|_| ()).unwrap_err();
        let refused = refused.to_string();
        assert!(
            refused.contains("another campaign") && refused.contains(part),
            "{refused}"
        );
    }
    assert_eq!(fs::read(folder.path().join(FILE)).unwrap(), before);
}

#[test]
fn a_changed_line_of_a_journal_is_refused() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let plan = Plan {
        scenarios: 16,
        ..plan
    };
    run(&plan, [0, 1], folder.path(), 2);
    let file = folder.path().join(FILE);
    let written = fs::read_to_string(&file).unwrap();
    let folders = [folder.path().to_path_buf()];
    assert!(merge(&folders, &tool()).is_ok());
    // A number of a record, the seal itself, and the first line, which the other lines rest on.
    for (from, to, part) in [
        (
            "\"ticks\":300,\"ending\"",
            "\"ticks\":299,\"ending\"",
            "line ",
        ),
        ("\"sha256\":\"", "\"sha256\":\"0", "line "),
        ("\"seed\":23", "\"seed\":24", "line 2"),
    ] {
        let (head, last) = written.split_at(if part == "line 2" {
            0
        } else {
            written.find('\n').unwrap()
        });
        assert!(last.contains(from), "{from}");
        fs::write(&file, format!("{head}{}", last.replacen(from, to, 1))).unwrap();
        let merged = merge(&folders, &tool()).unwrap_err().to_string();
        assert!(
            merged.contains(part) && merged.contains("not as it was written"),
            "{merged}"
        );
        let sources = plan.sources().unwrap();
        let resumed = campaign::run(&header(&plan, [0, 1]), &sources, folder.path(), &|_| ());
        assert!(resumed.is_err());
    }
}

/// What a diagnosis found, read from its file.
pub fn calibration(effects: &str) -> Calibration {
    let channel = |name: &str, unit: &str| {
        format!("{name} = {{ channel = \"{name}\", unit = \"{unit}\" }}\n")
    };
    let angles = channel("theta_a", "rad") + &channel("theta_b", "rad");
    let forces = channel("force_x", "N") + &channel("force_y", "N");
    let currents: String = ["current_a", "current_e", "current_b", "current_c"]
        .map(|name| channel(name, "A"))
        .concat();
    let text = format!(
        "name = \"a rig\"\nplant = \"rig\"\nlayout = \"four_brake\"\n[channels]\n{angles}{forces}{currents}{effects}"
    );
    let rig = FiveBar::parse(&text, Path::new("calibration.toml")).unwrap();
    Calibration::of(
        &rig,
        "calibration.toml".to_owned(),
        digest::of_bytes(text.as_bytes()),
    )
    .unwrap()
}

#[test]
fn a_calibration_is_the_plant_and_its_scenarios_are_those_without_it() {
    let effects = "[[effect]]\nmechanism = \"viscous\"\njoint = \"E\"\ncoefficient = { value = 0.37, unit = \"N·m·s/rad\", low95 = 0.21, high95 = 0.43 }\n\
         [[effect]]\nmechanism = \"gain_error\"\njoint = \"B\"\nfraction = { value = -0.13, unit = \"1\", low95 = -0.17, high95 = -0.07 }\n\
         [[effect]]\nmechanism = \"force_bias\"\nx = { value = 0.3, unit = \"N\" }\ny = { value = -0.2, unit = \"N\" }\n";
    let of = |calibration| Plan {
        rigs: vec![Rig::FourBrake],
        scenarios: 16,
        calibration,
        ..plan()
    };
    let (with, without) = (of(Some(calibration(effects))), of(None));
    let folder = tempfile::tempdir().unwrap();
    let runs = |name: &str, plan: &Plan| run(plan, [0, 1], &folder.path().join(name), 2);
    let (found, bare) = (runs("with", &with), runs("without", &without));
    assert_ne!(found, bare);
    for index in 0..16 {
        let (own, bare) = (with.scenario(index), without.scenario(index));
        assert_eq!(own.left_out.len(), 3);
        assert_eq!(
            Scenario {
                left_out: Vec::new(),
                ..own.clone()
            },
            bare
        );
        let text = serde_json::to_string(&own).unwrap();
        assert_eq!(serde_json::from_str::<Scenario>(&text).unwrap(), own);
    }
    let text = certificate(&with, &found);
    let read = Certificate::parse(&text, Path::new("certificate.json")).unwrap();
    assert!(
        read.laws.iter().all(|law| law.broken_in == 0),
        "{:?}",
        read.reasons
    );
    assert!(read.laws.iter().any(|law| law.law == Law::Passivity));
    let means = Means {
        sources: with.sources().unwrap(),
        kept: None,
        sample: 9,
        seed: 3,
    };
    assert!(recheck(&read, &means).unwrap().wrong.is_empty());
}

#[test]
fn what_stores_energy_leaves_passivity_out_and_says_so() {
    let spring = "[[effect]]\nmechanism = \"spring\"\njoint = \"A\"\nstiffness = { value = 0.7, unit = \"N·m/rad\" }\n";
    let plan = Plan {
        rigs: vec![Rig::FourBrake],
        scenarios: 16,
        calibration: Some(calibration(spring)),
        ..plan()
    };
    let folder = tempfile::tempdir().unwrap();
    let text = certificate(&plan, &run(&plan, [0, 1], folder.path(), 2));
    let read = Certificate::parse(&text, Path::new("certificate.json")).unwrap();
    assert!(
        read.laws.iter().all(|law| law.broken_in == 0),
        "{:?}",
        read.reasons
    );
    assert!(read.laws.iter().all(|law| law.law != Law::Passivity));
    assert!(
        read.not_looked_at
            .iter()
            .any(|not| not.what == "passivity" && not.why.contains("stores energy"))
    );
    // Judged all the same, it would be broken: the spring gives back what it took, and begins bent.
    let scenario = plan.scenario(5);
    assert!(!scenario.is_passive() && !scenario.left_out.is_empty());
}
