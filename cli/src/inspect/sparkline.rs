//! This file draws a signal in one line of text.

/// Characters of a line.
const WIDTH: usize = 32;
const BLOCKS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
const ASCII: [char; 8] = ['_', '.', ',', '-', '=', '+', '*', '#'];

/// The means of equally many samples as heights between the least and the greatest sample; a blank where all are
/// missing.
pub fn draw(samples: &[f64], range: Option<(f64, f64)>, ascii: bool) -> String {
    let (least, greatest) = range.unwrap_or((0.0, 0.0));
    let marks = if ascii { ASCII } else { BLOCKS };
    let count = samples.len().min(WIDTH);
    let line = (0..count).map(|k| {
        let part = k * samples.len() / count..(k + 1) * samples.len() / count;
        let part = samples.get(part).unwrap_or_default();
        let seen: Vec<f64> = part.iter().copied().filter(|x| x.is_finite()).collect();
        if seen.is_empty() {
            return ' ';
        }
        // Halves keep the span of very large numbers finite.
        let mean = seen.iter().map(|x| x / seen.len() as f64).sum::<f64>();
        let share = (mean / 2.0 - least / 2.0) / (greatest / 2.0 - least / 2.0);
        let height = if share.is_finite() { share * 7.0 } else { 3.0 };
        marks
            .get(height.round().clamp(0.0, 7.0) as usize)
            .copied()
            .unwrap_or(' ')
    });
    line.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_climbs_and_a_hole_stays_blank() {
        let mut ramp: Vec<f64> = (0..64).map(|k| 2.5 * f64::from(k) - 7.0).collect();
        ramp[40..44].fill(f64::NAN);
        let line = draw(&ramp, Some((-7.0, 150.5)), false);
        assert!(
            line.starts_with("▁▁▂▂▂") && line.ends_with("▇███"),
            "{line}"
        );
        assert_eq!(line.chars().count(), 32);
        assert_eq!(line.chars().skip(20).take(2).collect::<String>(), "  ");
        assert!(draw(&ramp, Some((-7.0, 150.5)), true).is_ascii());
        assert_eq!(draw(&[3.5, 3.5], Some((3.5, 3.5)), true), "--");
    }
}
