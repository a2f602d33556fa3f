//! This file adds remarks beside a result: repairs, and numbers that a careful reader would check.

use super::write::Stand;
use crate::cause::Cause;
use crate::continuity::Remark;
use crate::evidence::{Intervals, coefficients_by_term, parameters};
use crate::plant::{Clock, Plant, Run};
use crate::report::Floor;
use crate::rules::{CURVE_SHARE, FAR_BELOW_FLOOR};
use crate::selection::{floor_limit, refs};
use rigproof_model::effects::facts;
use rigproof_spec::effect::Mechanism;

impl<P: Plant> Stand<'_, P> {
    /// What was repaired, also in a held-out recording, and what is odd in the result.
    pub(crate) fn remarks(&self, floor: &Floor, intervals: &Intervals) -> Vec<Remark> {
        let shown = self.other_recording.then(|| self.test.remarks());
        let mut remarks = [self.train.remarks(), shown.unwrap_or_default()].concat();
        if floor.ratio_after < FAR_BELOW_FLOOR {
            remarks.push(self.odd("below_floor", "effort", format!(
                "the residual is {:.2} times what the stated noise and resolution predict: `noise` or `quantum` in the rig file is too large, which hides small effects",
                floor.ratio_after
            )));
        }
        let (nuisances, coefficients) = coefficients_by_term(self.problem, self.selection);
        for (value, half) in nuisances.iter().zip(&intervals.nuisances) {
            // NaN also means that nothing is determined.
            if half.is_nan() || value.abs() <= *half {
                remarks.push(self.odd("inertia_not_told", "inertia", format!(
                    "the inertia comes out as {value:.2e} (SI), and its 95 % interval holds 0: this recording does not determine it; state it as known, or record faster motion"
                )));
            }
        }
        let terms = refs(&self.selection.nominal, &self.selection.found);
        for (term, own) in terms.iter().zip(&coefficients) {
            let numbers = parameters(self.problem, term, own);
            if let (Mechanism::ChannelSkew, Some(delay_s)) = (term.cause.mechanism, numbers.first())
                && *delay_s < 0.0
            {
                remarks.push(self.odd("negative_delay", "time", format!(
                    "a delay of {delay_s:.2e} s is negative: the motion comes before its drive; check the time stamps of the two channels"
                )));
            }
        }
        let found = self.selection.found.iter().map(|own| own.term.cause);
        remarks.extend(found.filter_map(|cause| self.forms_of(cause)));
        remarks.extend(self.likest(floor));
        remarks
    }

    /// Says which cause of the library is most like what is left, where none is named.
    fn likest(&self, floor: &Floor) -> Option<Remark> {
        let (cause, share) = self.explanations.likest?;
        let is_open =
            self.selection.found.is_empty() && floor.ratio_after > floor_limit(self.problem);
        (is_open && share > CURVE_SHARE).then(|| {
            self.odd(
                "likest",
                "effect",
                format!(
                    "most like it is {} ({}), which alone takes away {:.0} % of its energy and is not likely enough to be named",
                    facts(cause.mechanism).map_or("", |facts| facts.words.what),
                    self.problem.name(cause),
                    100.0 * share
                ),
            )
        })
    }

    /// Says that a name stands for other forms of its law too.
    fn forms_of(&self, cause: Cause) -> Option<Remark> {
        let forms = self.explanations.other_forms(cause);
        let forms = forms
            .iter()
            .map(|(form, weight)| format!("`{}` ({:.0} %)", form.name(), 100.0 * weight));
        let forms = forms.collect::<Vec<_>>().join(", ");
        (!forms.is_empty()).then(|| {
            self.odd(
                "forms",
                "effect",
                format!(
                    "`{}` stands for another form of its law too, which this recording does not tell from it: {forms}",
                    self.problem.name(cause)
                ),
            )
        })
    }

    fn odd(&self, what: &'static str, channel: &'static str, words: String) -> Remark {
        Remark::throughout(self.train.clock(), what, channel, words)
    }
}

impl Remark {
    /// A remark on a whole recording.
    pub(crate) fn throughout(
        clock: Clock,
        what: &'static str,
        channel: &'static str,
        words: String,
    ) -> Remark {
        Remark {
            channel,
            what,
            from_s: clock.start_s,
            to_s: clock.start_s + clock.duration_s(),
            count: 1,
            words,
            cause: None,
        }
    }
}
