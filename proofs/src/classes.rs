//! This file counts how often a claim met each class of inputs that it has to meet.

/// Classes in the order in which they were met, and how often.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Classes(pub Vec<(&'static str, u64)>);

impl Classes {
    /// Counts a class, or names it where it was not met.
    pub fn count(&mut self, class: &'static str, met: bool) {
        match self.0.iter_mut().find(|(name, _)| *name == class) {
            Some((_, hits)) => *hits += u64::from(met),
            None => self.0.push((class, u64::from(met))),
        }
    }

    /// Whether there is a class, and none was never met.
    pub fn all_met(&self) -> bool {
        !self.0.is_empty() && self.0.iter().all(|(_, hits)| *hits > 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_never_met_is_dead() {
        let mut classes = Classes::default();
        assert!(!classes.all_met());
        classes.count("one", false);
        assert!(!classes.all_met());
        classes.count("one", true);
        assert!(classes.all_met());
        classes.count("other", false);
        assert!(!classes.all_met());
    }
}
