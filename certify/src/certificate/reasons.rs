//! This file says why a controller must not go on the rig.

use crate::finding::Named;
use crate::requirement::Requirement;
use crate::summary::{LawSummary, MetricSummary, TieSummary};

/// Why not, a sentence each; nothing where it may.
pub(super) fn reasons(
    laws: &[LawSummary],
    ties: &[TieSummary],
    findings: &[Named],
    metrics: &[MetricSummary],
    requirements: &[Requirement],
) -> Vec<String> {
    let mut reasons = Vec::new();
    for law in laws {
        let name = law.law.name();
        if let Some(first) = law.first_broken {
            let count = law.broken_in;
            reasons.push(format!(
                "the law {name} is broken in {count} scenarios, first in scenario {first}: {}",
                law.words
            ));
        } else if law.samples == 0 {
            reasons.push(format!(
                "the law {name} was held against no sample: run more or longer scenarios, or declare less"
            ));
        } else if !law.is_met() {
            let (trials, least) = (law.met.trials, law.met.least_trials);
            reasons.push(format!(
                "the premise of the law {name} was met in {trials} trials, and at least {least} are asked for: run more or longer scenarios, or declare less"
            ));
        }
    }
    for tie in ties.iter().filter(|tie| tie.trials > tie.most) {
        let (name, trials, most) = (tie.tie.name(), tie.trials, tie.most);
        reasons.push(format!(
            "beside the reference {trials} trials have ties of the kind {name}, where at most {most} may: {}",
            tie.words
        ));
    }
    for found in findings {
        let Some(target) = found.searched else {
            continue;
        };
        let (name, target, file) = (found.law.name(), target.name(), &found.file);
        let words = found.law.words();
        reasons.push(format!(
            "the law {name} is broken in a scenario that the search for a worse {target} met, {file}: {words}"
        ));
    }
    let limits = metrics.iter().flat_map(|metric| &metric.limits);
    let beyond = limits.filter(|limit| !limit.holds);
    reasons.extend(beyond.map(|beyond| beyond.words.clone()));
    // What stands for the thesis's sentences are laws that are looked at: they are reasons already.
    let own = requirements.iter().filter(|own| own.is_own());
    let empty = own.filter(|own| own.stands_for_nothing());
    reasons.extend(empty.map(|own| {
        let (says, by) = (&own.says, own.by.name());
        format!("nothing was looked at for the requirement “{says}”: {by} is not looked at, or has no limit")
    }));
    reasons
}
