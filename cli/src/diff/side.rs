//! This file is what a diagnosis or a calibration says, as far as two of them can be compared.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rigproof_report::words::called_at;
use rigproof_trace::store::read_text;
use serde_json::Value;

use crate::folder;
use crate::outcome::Failure;

/// A number with its unit and its 95 % interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    pub value: f64,
    pub unit: String,
    pub interval: Option<[f64; 2]>,
}

/// A file that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    pub path: String,
    pub sha256: String,
}

impl File {
    /// Its path, and enough of its hash to tell it from another.
    pub fn words(&self) -> String {
        let hash = self.sha256.get(..12).unwrap_or(&self.sha256);
        format!("{} ({hash})", self.path)
    }
}

/// One of the two.
pub struct Side {
    /// What messages call it.
    pub name: String,
    /// Whether it is a diagnosis and not a calibration.
    pub is_diagnosis: bool,
    /// Words that stand for themselves, such as the verdict.
    pub words: BTreeMap<&'static str, String>,
    /// The files that a diagnosis read.
    pub files: Vec<File>,
    /// Of what is named: how sure it is. A calibration does not say.
    pub named: BTreeMap<String, Option<f64>>,
    /// Numbers, by what they belong to and their own name.
    pub numbers: BTreeMap<(String, String), Number>,
    /// The page of a diagnosis.
    pub page: Option<PathBuf>,
}

impl Side {
    /// Reads the folder of a diagnosis, its report, or a calibration.
    ///
    /// # Errors
    /// It is neither.
    pub fn read(path: &Path) -> Result<Side, Failure> {
        let folder = path.is_dir();
        let file = if folder {
            path.join(folder::REPORT)
        } else {
            path.to_path_buf()
        };
        let text = read_text(&file)?;
        let unusable = |why: String| Failure::unusable(&file, why);
        let mut side = if file.extension().is_some_and(|own| own == "toml") {
            let table = text.parse::<toml::Table>();
            Side::of_calibration(&table.map_err(|error| unusable(error.message().to_owned()))?)
        } else {
            let report: Value = serde_json::from_str(&text).map_err(|error| {
                unusable(format!(
                    "{error}; give the folder of a diagnosis, or a calibration"
                ))
            })?;
            if report.get("verdict").is_none() {
                let problem = "it is no report of a diagnosis: no verdict stands in it";
                return Err(unusable(problem.to_owned()));
            }
            Side::of_report(&report)
        };
        side.name = path.display().to_string();
        side.page = side.is_diagnosis.then(|| file.with_file_name(folder::PAGE));
        Ok(side)
    }

    fn empty(is_diagnosis: bool) -> Side {
        Side {
            name: String::new(),
            is_diagnosis,
            words: BTreeMap::new(),
            files: Vec::new(),
            named: BTreeMap::new(),
            numbers: BTreeMap::new(),
            page: None,
        }
    }

    pub(super) fn of_report(report: &Value) -> Side {
        let mut side = Side::empty(true);
        let text = |pointer: &str| report.pointer(pointer).and_then(Value::as_str);
        for (words, pointer) in [("verdict", "/verdict"), ("tool", "/tool")] {
            let said = text(pointer).map(|own| own.replace('_', " "));
            side.words.extend(said.map(|own| (words, own)));
        }
        let inputs = report.get("inputs").and_then(Value::as_array);
        let files = inputs.into_iter().flatten().filter_map(|own| {
            let word = |key: &str| Some(own.get(key)?.as_str()?.to_owned());
            Some(File {
                path: word("path")?,
                sha256: word("sha256")?,
            })
        });
        side.files.extend(files);
        let effects = report.get("effects").and_then(Value::as_array);
        for effect in effects.into_iter().flatten() {
            let joint = effect.get("joint").and_then(Value::as_str);
            let mechanism = effect.get("mechanism").and_then(Value::as_str);
            let name = called_at(mechanism.unwrap_or("?"), joint);
            let probability = effect.get("probability").and_then(Value::as_f64);
            side.named.insert(name.clone(), probability);
            side.take(&name, effect.get("parameters"));
        }
        side.take("the model's own numbers", report.get("nominal"));
        for (name, pointer) in [
            ("before", "/fit/held_out/before"),
            ("after", "/fit/held_out/after"),
        ] {
            let value = report.pointer(pointer).and_then(Value::as_f64);
            let unit = text("/fit/unit").unwrap_or_default();
            side.numbers.extend(value.map(|value| {
                let number = Number {
                    value,
                    unit: unit.to_owned(),
                    interval: None,
                };
                (
                    ("error on held-out data".to_owned(), name.to_owned()),
                    number,
                )
            }));
        }
        side
    }

    /// The numbers of a table of them.
    fn take(&mut self, of: &str, numbers: Option<&Value>) {
        let all = numbers.and_then(Value::as_object).into_iter().flatten();
        for (name, own) in all {
            let of_key = |key: &str| own.get(key).and_then(Value::as_f64);
            let Some(value) = of_key("value") else {
                continue;
            };
            let unit = own.get("unit").and_then(Value::as_str).unwrap_or_default();
            let number = Number {
                value,
                unit: unit.to_owned(),
                interval: of_key("low95").zip(of_key("high95")).map(|(a, b)| [a, b]),
            };
            self.numbers
                .insert((of.to_owned(), name.replace('_', " ")), number);
        }
    }

    fn of_calibration(table: &toml::Table) -> Side {
        let mut side = Side::empty(false);
        let json = |value: &toml::Value| serde_json::to_value(value).unwrap_or(Value::Null);
        let name = table.get("name").and_then(toml::Value::as_str);
        side.words.extend(name.map(|name| ("rig", name.to_owned())));
        for (key, value) in table {
            match value {
                toml::Value::Table(_) => side.take(key, Some(&json(value))),
                toml::Value::Array(effects) if key == "effect" => {
                    for effect in effects {
                        let word = |key: &str| effect.get(key).and_then(toml::Value::as_str);
                        let joint = word("joint").or(word("at"));
                        let name = called_at(word("mechanism").unwrap_or("?"), joint);
                        side.named.insert(name.clone(), None);
                        side.take(&name, Some(&json(effect)));
                    }
                }
                _ => {}
            }
        }
        side
    }
}
