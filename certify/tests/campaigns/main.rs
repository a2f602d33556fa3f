//! This file joins the tests of campaigns: what passes, what is refused, and what a certificate is worth.

mod bent;
mod certificates;
mod covered;
mod five;
mod forged;
mod plain;
mod planted;
mod recorded;
mod runs;
mod searched;
