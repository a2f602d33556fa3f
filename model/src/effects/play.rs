//! This file is the play that a brake's current moves: what stays of the current that was.

/// A play operator whose sides come together towards no current (a generalised play: Visintin, Differential Models of Hysteresis, 1994).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentPlay {
    /// How far the play stays behind the current on either side, A; above 0.
    pub half_width_a: f64,
    /// The current below which the sides come together, A: none of it stays where no current flows. 0 for sides that do not.
    pub closing_a: f64,
}

impl CurrentPlay {
    /// Where the play stands, A, that stood at `play_a` before the current came to `current_a`.
    pub fn moved(&self, play_a: f64, current_a: f64) -> f64 {
        let open = if current_a < self.closing_a {
            (current_a / self.closing_a).max(0.0)
        } else {
            1.0
        };
        let half_a = open * self.half_width_a;
        play_a.clamp(current_a - half_a, current_a + half_a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_play_stays_behind_on_both_ways_and_closes_only_where_its_sides_do() {
        let open = CurrentPlay {
            half_width_a: 0.07,
            closing_a: 0.0,
        };
        let closing = CurrentPlay {
            closing_a: 0.4,
            ..open
        };
        for (play, at_rest) in [(open, 0.07), (closing, 0.0)] {
            let up = play.moved(0.0, 0.53);
            assert!((up - 0.46).abs() < 1e-12, "{up}");
            assert_eq!(play.moved(up, 0.41), up);
            let down = play.moved(up, 0.31);
            let half = if play == open {
                0.07
            } else {
                0.07 * 0.31 / 0.4
            };
            assert!((down - (0.31 + half)).abs() < 1e-12, "{down}");
            let gone = play.moved(down, 0.0);
            assert!((gone - at_rest).abs() < 1e-12, "{gone}");
        }
    }
}
