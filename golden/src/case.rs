//! This file says what a case is: what goes in, what the model makes of it, and what must be seen in that.

use crate::table::Table;
use crate::{Claim, Error};

/// One case: a folder of the same name.
pub struct Case {
    /// Its name.
    pub name: String,
    /// What it is for.
    pub purpose: String,
    /// Where the thesis speaks of it: equations and sections.
    pub citations: Vec<&'static str>,
    /// Step in which the model is run, s.
    pub step_s: f64,
    /// Time between the rows of `expected.csv`, s.
    pub rows_s: f64,
    /// What holds for every run.
    pub parameters: Vec<Parameter>,
    /// The runs, numbered from one in the column `run`.
    pub runs: Vec<Run>,
    /// What the files must contain.
    pub must_show: Vec<Claim>,
    pub(crate) input: Compute<()>,
    pub(crate) expected: Compute<Table>,
}

/// How a table is made.
pub(crate) type Compute<From> = Box<dyn Fn(&From) -> Result<Table, Error> + Send + Sync>;

/// One run of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// What happens, in a few words.
    pub what: String,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
}

/// One parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its value.
    pub value: Value,
    /// The unit of a number; empty for a word.
    pub unit: &'static str,
}

/// A parameter's value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number with a unit.
    Number(f64),
    /// A name.
    Word(String),
}

impl Parameter {
    /// A number with its unit.
    pub fn number(name: &'static str, value: f64, unit: &'static str) -> Parameter {
        Parameter {
            name,
            value: Value::Number(value),
            unit,
        }
    }

    /// A name.
    pub fn word(name: &'static str, value: impl Into<String>) -> Parameter {
        Parameter {
            name,
            value: Value::Word(value.into()),
            unit: "",
        }
    }
}

impl Case {
    /// `input.csv` and `expected.csv`, computed: the model is given the input in the digits that are written.
    ///
    /// # Errors
    /// The model refuses.
    pub fn compute(&self) -> Result<(Table, Table), Error> {
        let input = (self.input)(&())?;
        let expected = (self.expected)(&input)?;
        Ok((input, expected))
    }

    /// `expected.csv`, computed from an `input.csv`.
    ///
    /// # Errors
    /// The input lacks a column, or the model refuses.
    pub fn expected(&self, input: &Table) -> Result<Table, Error> {
        (self.expected)(input)
    }
}
