//! This file reads the errata and gaps of the thesis, and says which concern an equation.

use serde_json::{Map, Value};

use super::equation::SECTION;
use super::repository::{Repository, Source};
use crate::outcome::Failure;

/// Which of the two files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Where the print is wrong.
    Erratum,
    /// What it leaves open.
    Gap,
}

impl Kind {
    /// The file, and what its entries are called.
    const fn names(self) -> (&'static str, &'static str) {
        match self {
            Kind::Erratum => ("spec/thesis/errata.toml", "erratum"),
            Kind::Gap => ("spec/thesis/gaps.toml", "gap"),
        }
    }
}

/// One entry: its keys and their words, in the order of the alphabet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Record {
    fields: Vec<(String, String)>,
}

/// Every entry of a file.
///
/// # Errors
/// The file cannot be read, or is no such file.
pub fn all(repository: &Repository, kind: Kind) -> Result<Vec<Record>, Failure> {
    let (path, name) = kind.names();
    records(&repository.read(path)?, name)
        .map_err(|problem| Failure::Input(format!("`{path}` of the repository: {problem}")))
}

fn records(text: &str, name: &str) -> Result<Vec<Record>, String> {
    let table: toml::Table = text.parse().map_err(|error: toml::de::Error| {
        let line = error.span().map_or(1, |span| {
            text.bytes()
                .take(span.start)
                .filter(|b| *b == b'\n')
                .count()
                + 1
        });
        format!("line {line}: {}", error.message())
    })?;
    let entries = table.get(name).and_then(toml::Value::as_array);
    let entries = entries.ok_or_else(|| format!("there is no [[{name}]] in it"))?;
    let record = |entry: &toml::Value| Record {
        fields: entry
            .as_table()
            .into_iter()
            .flatten()
            .filter_map(|(key, value)| Some((key.clone(), value.as_str()?.to_owned())))
            .collect(),
    };
    Ok(entries.iter().map(record).collect())
}

/// The keys in the order in which they are printed.
const SHOWN: [&str; 9] = [
    "where", "printed", "intended", "reason", "open", "chosen", "evidence", "at", "decision",
];

impl Record {
    fn get(&self, key: &str) -> Option<&str> {
        let field = self.fields.iter().find(|(known, _)| known == key);
        field.map(|(_, value)| value.as_str())
    }

    /// Whether it is the entry of an equation.
    pub fn is_of(&self, number: &str) -> bool {
        self.get("equation") == Some(number)
    }

    /// Whether it is the entry of an equation, or names it; of a section, whether that is where it stands.
    pub fn concerns(&self, number: &str) -> bool {
        if let Some(section) = number.strip_prefix(SECTION) {
            return self.get("where").is_some_and(|place| {
                let mut words = place.split([' ', ',', ';']);
                words.any(|word| word.trim_start_matches(SECTION) == section)
            });
        }
        let name = format!("({number})");
        self.is_of(number) || self.fields.iter().any(|(_, value)| value.contains(&name))
    }

    /// Adds where the test stands that is its evidence.
    pub fn locate(&mut self, sources: &[Source]) {
        let Some(test) = self.get("evidence") else {
            return;
        };
        let place = sources.iter().find_map(|source| {
            let line = source.line_of_function(test)?;
            Some(format!("{}:{line}", source.path))
        });
        self.fields
            .extend(place.map(|place| ("at".to_owned(), place)));
    }

    /// Its id, and under it a line for each key.
    pub fn lines_of_text(&self) -> Vec<String> {
        let id = self.get("id").unwrap_or("(no id)");
        let equation = self.get("equation");
        let equation = equation.map_or(String::new(), |number| {
            format!(", entered under ({number})")
        });
        let shown = SHOWN
            .iter()
            .filter_map(|key| Some(format!("    {key:<9} {}", self.get(key)?)));
        std::iter::once(format!("  `{id}`{equation}"))
            .chain(shown)
            .collect()
    }

    /// The same as JSON.
    pub fn json(&self) -> Value {
        let fields = self.fields.iter().cloned();
        let fields = fields.map(|(key, value)| (key, Value::String(value)));
        Value::Object(fields.collect::<Map<String, Value>>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_concerns_the_equation_it_is_entered_under_and_those_it_names() {
        let text = "[[erratum]]\nid = \"two\"\nequation = \"5.22\"\nprinted = \"and λ4 of (5.24) likewise\"\n";
        let records = records(text, "erratum").unwrap();
        let [record] = records.as_slice() else {
            panic!("{records:?}");
        };
        let concerns = ["5.22", "5.24", "5.2"].map(|number| record.concerns(number));
        assert_eq!(concerns, [true, true, false]);
        assert!(record.is_of("5.22") && !record.is_of("5.24"));
        assert_eq!(
            record.lines_of_text(),
            [
                "  `two`, entered under (5.22)",
                "    printed   and λ4 of (5.24) likewise"
            ]
        );
    }

    #[test]
    fn a_record_concerns_the_sections_in_which_it_stands() {
        let text = "[[gap]]\nid = \"one\"\nwhere = \"sections 2.2.1, 1.1\"\nopen = \"(5.1)\"\n";
        let records = records(text, "gap").unwrap();
        let concerns = ["§2.2.1", "§1.1", "§2.2", "2.2.1", "5.1"].map(|n| records[0].concerns(n));
        assert_eq!(concerns, [true, true, false, false, true]);
    }

    #[test]
    fn a_file_that_is_none_is_refused_with_its_line() {
        let problem = records("[[gap]]\nid = \"x\"\nopen = 'y\n", "gap").unwrap_err();
        assert!(problem.starts_with("line 3: "), "{problem}");
        assert!(records("[[gap]]\n", "erratum").is_err());
    }
}
