//! This file says where a tip can go while one row of a display is locked.

use super::Margin;

/// Whether the tip moves along the local path of a locked row: at right angles to its force; the margin is what is left of
/// `slack`, W/(N·m) = rad/s.
///
/// `row` is the tip force of the row at 1 N·m, 1/m. Times the tip's velocity, m/s, it is the rate of the row, which a lock makes zero.
///
/// Source: chapter 1, "PTER is capable of locking the tip into any one of four local SDOF paths"; §4.3, local paths "lie
/// perpendicular to the available force vectors".
pub fn local_path(row: [f64; 2], tip_velocity_m_s: [f64; 2], slack: f64) -> Margin {
    let [row_x, row_y] = row;
    let [velocity_x, velocity_y] = tip_velocity_m_s;
    Margin(slack - (row_x * velocity_x + row_y * velocity_y).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tip_that_leaves_its_path_breaks_the_law() {
        let row = [3.1, -1.3];
        assert!(local_path(row, [0.13, 0.31], 1e-12).holds());
        assert!(local_path(row, [-0.26, -0.62], 1e-12).holds());
        assert!(!local_path(row, [0.14, 0.31], 1e-3).holds());
        assert!(!local_path(row, [f64::NAN, 0.31], 1e-3).holds());
    }
}
