//! This file joins the tests of velocity from counts: which estimator, and whether both rooms compute the same.

mod agree;
mod candidates;
mod choice;
mod motions;
mod score;
