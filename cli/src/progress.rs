//! This file shows that work goes on: on the error stream, and only where that is a terminal.

use std::time::Duration;

use rigproof_diagnose::Watch;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};

/// A turning mark for work of unknown length; it vanishes when dropped.
pub fn spinner(doing: &'static str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    let bar = styled(bar, "{spinner} {msg} {elapsed}").with_message(doing);
    bar.enable_steady_tick(Duration::from_millis(120));
    bar
}

/// A turning mark that names the stage of a diagnosis, and who has to be told of the stages.
pub fn stages() -> (ProgressBar, Watch) {
    let mark = spinner("diagnosing");
    let told = mark.clone();
    (
        mark,
        Watch::new(move |stage| told.set_message(stage.doing())),
    )
}

/// A bar for work of known length; it vanishes when dropped.
pub fn bar(length: usize, unit: &'static str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(length as u64), ProgressDrawTarget::stderr());
    styled(bar, "{wide_bar} {pos} of {len} {msg}, {eta} left").with_message(unit)
}

/// Shows nothing: somebody else is told of the work.
pub fn nothing(_: usize, _: &'static str) -> ProgressBar {
    ProgressBar::hidden()
}

/// indicatif draws on a terminal only; a template that it cannot read leaves its own.
fn styled(bar: ProgressBar, template: &str) -> ProgressBar {
    let bar = bar.with_finish(ProgressFinish::AndClear);
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
