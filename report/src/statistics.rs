//! This file says how a residual is distributed and how far it resembles itself later.

/// Bars of a histogram between `-reach` and `reach`: middles, and share of the values a unit of the abscissa. What lies beyond is in the outermost bars.
pub fn histogram(values: &[f64], reach: f64, bars: usize) -> (Vec<f64>, Vec<f64>) {
    let width = 2.0 * reach / bars as f64;
    let mut counts = vec![0.0; bars];
    let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    for value in &finite {
        let bar = ((value + reach) / width)
            .floor()
            .clamp(0.0, bars as f64 - 1.0) as usize;
        if let Some(count) = counts.get_mut(bar) {
            *count += 1.0;
        }
    }
    let whole = finite.len().max(1) as f64 * width;
    let middles = (0..bars)
        .map(|k| (k as f64 + 0.5) * width - reach)
        .collect();
    (
        middles,
        counts.into_iter().map(|count| count / whole).collect(),
    )
}

/// The density of the normal distribution of mean 0 and deviation 1.
pub fn normal(x: f64) -> f64 {
    libm::exp(-0.5 * x * x) / core::f64::consts::TAU.sqrt()
}

/// Autocorrelation at the lags `0..lags`; pairs with a gap in them do not count. Nothing where nothing varies.
pub fn autocorrelation(values: &[f64], lags: usize) -> Vec<f64> {
    let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    let mean = finite.iter().sum::<f64>() / finite.len().max(1) as f64;
    let variance =
        finite.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / finite.len().max(1) as f64;
    // What rounding leaves of a constant is no variation.
    if variance.is_nan() || variance <= 1e-24 * mean * mean {
        return Vec::new();
    }
    let at = |lag: usize| {
        let pairs = values.iter().zip(values.iter().skip(lag));
        let products = pairs
            .map(|(a, b)| (a - mean) * (b - mean))
            .filter(|p| p.is_finite());
        let (count, sum) = products.fold((0.0, 0.0), |(count, sum), p| (count + 1.0, sum + p));
        if count > 0.0 {
            sum / count / variance
        } else {
            0.0
        }
    };
    (0..lags.min(values.len())).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_histogram_counts_everything_once() {
        let (middles, density) = histogram(&[-7.0, -0.4, 0.3, 0.3, 2.9, f64::NAN], 3.0, 6);
        assert_eq!(middles, [-2.5, -1.5, -0.5, 0.5, 1.5, 2.5]);
        assert_eq!(density, [0.2, 0.0, 0.2, 0.4, 0.0, 0.2]);
        assert!((normal(0.0) - 0.398_942_280_401_432_7).abs() < 1e-15);
    }

    #[test]
    fn a_wave_resembles_itself_after_its_period() {
        let wave: Vec<f64> = (0..4000)
            .map(|k| libm::sin(core::f64::consts::TAU * f64::from(k) / 40.0))
            .collect();
        let own = autocorrelation(&wave, 41);
        assert!(
            (own[0] - 1.0).abs() < 1e-12
                && (own[20] + 1.0).abs() < 1e-2
                && (own[40] - 1.0).abs() < 1e-2
        );
        assert!(autocorrelation(&[1.7; 9], 4).is_empty());
    }
}
