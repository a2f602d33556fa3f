//! This file says what a certificate is worth: a changed byte is refused, and what was run can be run again.

use std::path::Path;

use rigproof_certify::built_in::BuiltIn;
use rigproof_certify::certificate::Certificate;
use rigproof_certify::controller::{Controller, Failure, Source, Task};
use rigproof_certify::differential::tie::Tie;
use rigproof_certify::digest;
use rigproof_certify::finding::Finding;
use rigproof_certify::journal::Chunks;
use rigproof_certify::law::Law;
use rigproof_certify::plan::{Plan, Sources};
use rigproof_certify::proved::Ledger;
use rigproof_certify::record::Record;
use rigproof_impl::tick::{Sensed, Settings};
use rigproof_spec::methods::Method;

use crate::runs::{certificate, plan, run};

fn text() -> (Plan, String) {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let text = certificate(&plan, &run(&plan, [0, 1], folder.path(), 2));
    (plan, text)
}

fn parse(text: &str) -> Result<Certificate, String> {
    Certificate::parse(text, Path::new("certificate.json")).map_err(|error| error.to_string())
}

#[test]
fn a_changed_byte_anywhere_is_refused() {
    let (_, text) = text();
    assert!(parse(&text).is_ok());
    let bytes = text.as_bytes();
    let mut tried = 0;
    for place in (0..bytes.len()).step_by(13) {
        for flip in [1, 2, 16] {
            let mut changed = bytes.to_vec();
            changed[place] ^= flip;
            let Ok(changed) = String::from_utf8(changed) else {
                continue;
            };
            tried += 1;
            assert!(parse(&changed).is_err(), "byte {place}, {flip}");
        }
    }
    assert!(tried > 1000);
    assert!(parse(text.trim_end()).is_err());
    assert!(parse(&(text + " ")).is_err());
}

#[test]
fn a_certificate_of_another_ledger_is_read_and_said_to_be_one() {
    let (_, text) = text();
    let mut older = parse(&text).unwrap();
    assert_eq!(older.ledger().unwrap(), Ledger::Same);
    let sealed = |mut certificate: Certificate| {
        certificate.digest = String::new();
        certificate.digest = digest::of_bytes(certificate.to_json().unwrap().as_bytes());
        parse(&certificate.to_json().unwrap())
    };
    older.proved.claims.truncate(7);
    let changed = sealed(older.clone()).unwrap_err();
    assert!(changed.contains("calls proved"), "{changed}");
    older.proved.code = Some("0f".repeat(32));
    let read = sealed(older).unwrap();
    let other = Ledger::Other {
        known: 7,
        claims: 7,
    };
    assert_eq!(read.ledger().unwrap(), other);
}

#[test]
fn a_controller_that_breaks_at_the_end_or_when_it_is_begun_again_did_not_answer() {
    for broken in [Broken::AtTheEnd, Broken::BegunAgain] {
        let plan = plan();
        let sources = Sources {
            controller: &broken,
            baseline: None,
        };
        let index = 3;
        let record = Record::of(&plan, &sources, index).unwrap();
        let fared = record.fared[Law::Answers as usize];
        assert_eq!(fared.broken, 1);
        assert_eq!(fared.first, Some(record.ticks));
        assert_eq!(
            record.failure.as_deref(),
            Some("the controller answered with status 7")
        );
        let found = Finding::of(&plan, &broken, Law::Answers, index)
            .unwrap()
            .unwrap();
        assert_eq!(found.failure, record.failure);
        assert_eq!(found.named().unwrap().failure, record.failure);
        assert!(found.tick < 60, "{}", found.tick);
    }
}

/// A sound controller that breaks where no sample is.
enum Broken {
    AtTheEnd,
    BegunAgain,
}

struct Ending(Box<dyn Controller>, Result<(), Failure>);

impl Controller for Ending {
    fn tick(&mut self, sensed: &Sensed<f64>) -> Result<[f64; 4], Failure> {
        self.0.tick(sensed)
    }

    fn end(&mut self) -> Result<(), Failure> {
        self.1.clone()
    }
}

impl Source for Broken {
    fn begin(&self, settings: &Settings, task: &Task) -> Result<Box<dyn Controller + '_>, Failure> {
        let end = match self {
            Broken::AtTheEnd => Err(Failure::Status(7)),
            Broken::BegunAgain => Ok(()),
        };
        let sound = BuiltIn::of(Method::ProportionalLow).controller(settings, task)?;
        Ok(Box::new(Ending(sound, end)))
    }

    fn begin_again(
        &self,
        _settings: &Settings,
        _task: &Task,
    ) -> Result<Box<dyn Controller + '_>, Failure> {
        Err(Failure::Status(7))
    }
}

#[test]
fn a_finding_breaks_its_law_again_from_its_file() {
    let mut plan = plan();
    plan.controller.declared.gap_m = Some(0.02);
    let sources = plan.sources().unwrap();
    let found = (0..plan.scenarios)
        .find_map(|index| Finding::of(&plan, sources.controller, Law::Gap, index).unwrap());
    let found = found.unwrap();
    let read = Finding::parse(&found.to_json().unwrap(), Path::new("finding-gap.json")).unwrap();
    assert_eq!(read, found);
    let ran = read.replayed(sources.controller).unwrap();
    let (_, fared) = ran.broken().find(|(law, _)| *law == Law::Gap).unwrap();
    assert_eq!((fared.first, fared.worst), (Some(found.tick), found.margin));
    assert!(found.tick < 60, "{} ms", found.tick);
    assert!(found.to_mcap(sources.controller).unwrap().len() > 1000);
}

#[test]
fn more_trials_with_ties_than_there_may_be_are_a_reason_against() {
    let plan = plan();
    let folder = tempfile::tempdir().unwrap();
    let mut chunks = run(&plan, [0, 1], folder.path(), 2);
    let of = |chunks: &Chunks| parse(&certificate(&plan, chunks)).unwrap();
    let of_ties = |read: &Certificate| {
        let reasons = read.reasons.iter();
        let reasons = reasons.filter(|reason| reason.contains("ties of the kind"));
        reasons.cloned().collect::<Vec<_>>()
    };
    assert!(of_ties(&of(&chunks)).is_empty());
    let records = chunks.values_mut().flatten();
    records.for_each(|record| record.ties.add(Tie::Velocity));
    let refused = of(&chunks);
    let reason =
        "beside the reference 44 trials have ties of the kind velocity, where at most 10 may";
    let reasons = of_ties(&refused);
    assert!(!refused.may_go_on_the_rig && reasons.len() == 1 && reasons[0].starts_with(reason));
    let mut ties = refused.ties.iter();
    let own = ties.find(|own| own.tie == Tie::Velocity).unwrap();
    assert_eq!((own.trials, own.most), (44, 10));
    for (tie, most) in [(Tie::Foot, 400), (Tie::Amplified, 100), (Tie::Level, 40)] {
        assert_eq!(tie.budget().most(2000), most);
    }
    let names = Tie::ALL.map(|tie| serde_json::to_value(tie).unwrap());
    assert_eq!(names, Tie::ALL.map(Tie::name));
}
