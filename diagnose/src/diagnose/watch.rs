//! This file reports the progress of a diagnosis.

use std::fmt;
use std::sync::Arc;

/// A stage of a diagnosis, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Channels are resampled, and the nominal model is fitted.
    Align,
    /// Sets of mechanisms are compared.
    Explain,
    /// Parameters are fitted, uncertainties estimated, and free runs computed.
    Show,
}

impl Stage {
    /// Every stage.
    pub const ALL: [Stage; 3] = [Stage::Align, Stage::Explain, Stage::Show];

    /// What is being done, for a person who waits.
    pub const fn doing(self) -> &'static str {
        match self {
            Stage::Align => "step 1 of 3: setting the model against the recording",
            Stage::Explain => "step 2 of 3: looking for the cause",
            Stage::Show => "step 3 of 3: fitting numbers and running before against after",
        }
    }
}

/// A callback for every stage; none by default.
#[derive(Clone, Default)]
pub struct Watch(Option<Arc<dyn Fn(Stage) + Send + Sync>>);

impl Watch {
    /// Calls `whom` at the start of every stage.
    pub fn new(whom: impl Fn(Stage) + Send + Sync + 'static) -> Watch {
        Watch(Some(Arc::new(whom)))
    }

    pub(crate) fn enters(&self, stage: Stage) {
        if let Some(whom) = &self.0 {
            whom(stage);
        }
    }
}

impl fmt::Debug for Watch {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self.0 {
            Some(_) => "Watch(somebody)",
            None => "Watch(nobody)",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn who_watches_is_told_of_each_stage_as_it_begins() {
        let told = Arc::new(Mutex::new(Vec::new()));
        let own = Arc::clone(&told);
        let watch = Watch::new(move |stage| own.lock().unwrap().push(stage));
        Stage::ALL.into_iter().for_each(|stage| watch.enters(stage));
        Watch::default().enters(Stage::Show);
        assert_eq!(*told.lock().unwrap(), Stage::ALL);
    }
}
