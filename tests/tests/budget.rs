//! This file holds measured disagreements against the budgets that the project allows itself.

/// Compares quantiles with the entry of `budgets.toml`.
pub fn assert_within_budget(name: &str, mut values: Vec<f64>) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/budgets.toml");
    let budgets: toml::Table = std::fs::read_to_string(path).unwrap().parse().unwrap();
    values.sort_by(f64::total_cmp);
    for (key, rank) in [("q75", 0.75), ("q99", 0.99), ("max", 1.0)] {
        let budget = budgets[name][key].as_float().unwrap();
        let value = values[((values.len() - 1) as f64 * rank) as usize];
        println!("{name}: {key} is {value:e} of {budget:e}");
        assert!(
            value <= budget,
            "{name}: {key} is {value:e}, tests/budgets.toml allows {budget:e}"
        );
    }
}
