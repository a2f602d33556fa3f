//! This file reads the inputs and the parameters of the golden cases.

use std::fs;
use std::path::PathBuf;

use rigproof_golden::{Manifest, Table};
use rigproof_spec::layout::Layout;

/// A golden case as it is checked in.
pub struct Script {
    pub case: String,
    pub input: Table,
    pub expected: Table,
    pub manifest: Manifest,
}

impl Script {
    pub fn of(case: &str) -> Script {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../golden/cases");
        let read = |file: &str| fs::read(folder.join(case).join(file)).unwrap();
        Script {
            case: case.to_owned(),
            input: Table::parse(&read("input.csv")).unwrap(),
            expected: Table::parse(&read("expected.csv")).unwrap(),
            manifest: toml::from_slice(&read("manifest.toml")).unwrap(),
        }
    }

    pub fn runs(&self) -> std::ops::RangeInclusive<usize> {
        1..=self.manifest.run.len()
    }

    pub fn numbers(&self, run: usize, column: &str) -> Vec<f64> {
        self.input.numbers(run, column).unwrap()
    }

    /// When a run of the reference ended, s.
    pub fn end_s(&self, run: usize) -> f64 {
        *self.expected.numbers(run, "time").unwrap().last().unwrap()
    }

    pub fn first(&self, run: usize, column: &str) -> f64 {
        self.numbers(run, column)[0]
    }

    /// A parameter of the case or of a run of it.
    fn parameter(&self, run: usize, name: &str) -> &toml::Value {
        let own = self.manifest.run[run - 1].parameters.iter();
        let mut all = own.chain(&self.manifest.parameters);
        let found = all.find(|entry| entry.name == name);
        &found
            .unwrap_or_else(|| panic!("{} has no {name}", self.case))
            .value
    }

    pub fn number(&self, run: usize, name: &str) -> f64 {
        self.parameter(run, name).as_float().unwrap()
    }

    pub fn word(&self, run: usize, name: &str) -> &str {
        self.parameter(run, name).as_str().unwrap()
    }

    pub fn layout(&self) -> Layout {
        match self.word(1, "layout") {
            "three_brake" => Layout::ThreeBrake,
            "four_brake" => Layout::FourBrake,
            other => panic!("{other}"),
        }
    }
}
