//! This file joins the tests of the verbs, which run the program as a person does.

mod attack;
mod bad_diagnosis;
mod bad_input;
mod blind;
mod browser;
mod certify;
mod cite;
mod controller;
mod convert;
mod crowd;
mod demo;
mod design;
mod desk;
mod diagnose;
mod experiment;
mod golden;
mod guide;
mod help;
mod identify;
mod inspect;
mod kills;
mod mcap;
mod mistakes;
mod new;
mod reproduce;
mod serve;
