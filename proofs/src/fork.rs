//! This file walks a tree of decisions by running the same code again, each time along the next branch.

/// Which branches were taken, and how many there are at each.
#[derive(Clone, Debug, Default)]
pub struct Forks {
    taken: Vec<(u8, u8)>,
    reached: usize,
}

impl Forks {
    /// The branch to take here, below `count`.
    pub fn take(&mut self, count: u8) -> u8 {
        if self.reached == self.taken.len() {
            self.taken.push((0, count));
        }
        let (branch, _) = self.taken[self.reached];
        self.reached += 1;
        branch
    }

    /// Goes back to the root, to walk the next path; `false` when all were walked.
    pub fn advance(&mut self) -> bool {
        self.taken.truncate(self.reached);
        self.reached = 0;
        while let Some((branch, count)) = self.taken.pop() {
            if branch + 1 < count {
                self.taken.push((branch + 1, count));
                return true;
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_path_is_walked_once() {
        // Three branches; below the second of them two more.
        let mut forks = Forks::default();
        let mut walked = Vec::new();
        loop {
            let first = forks.take(3);
            walked.push((first, (first == 1).then(|| forks.take(2))));
            if !forks.advance() {
                break;
            }
        }
        assert_eq!(walked, [(0, None), (1, Some(0)), (1, Some(1)), (2, None)]);
    }
}
