//! This file makes the pages of a thesis run again: one of one chapter; of several an index, and a page for each.

use std::path::{Path, PathBuf};

use rigproof_experiments::{Finding, Verdict};
use rigproof_report::compared::{self, Again, Chapter, Statement};

use super::Done;
use crate::picture;

/// The words for verdicts, in the order of a page.
fn words() -> compared::Words {
    let words = [
        Verdict::Agrees,
        Verdict::Disagrees,
        Verdict::CannotBeCompared,
    ];
    words.map(Verdict::name)
}

/// The pages with every statement and picture, and their files: of one chapter one, of several an index and one each. `out` is the folder with the numbers.
pub fn pages(file: &Path, out: &Path, done: &[Done]) -> Vec<(PathBuf, String)> {
    let mut chapters: Vec<Chapter> = Vec::new();
    for own in done {
        let name = chapter(own.experiment.id);
        match chapters.iter_mut().find(|known| known.name == name) {
            Some(known) => known.experiments.push(again(out, own)),
            None => chapters.push(Chapter {
                file: beside(file, &name),
                experiments: vec![again(out, own)],
                name,
            }),
        }
    }
    let open = |chapter: Option<&str>| {
        let findings = done
            .iter()
            .filter(|own| chapter.is_none_or(|name| self::chapter(own.experiment.id) == name))
            .flat_map(|done| &done.left.findings);
        findings.filter(|own| own.is_unaccounted()).count()
    };
    if let [only] = chapters.as_slice() {
        let page = compared::page(&only.experiments, words(), open(None), None);
        return vec![(file.to_path_buf(), page)];
    }
    let index = file.file_name().map(|name| name.to_string_lossy());
    let each = chapters.iter().map(|own| {
        let page = compared::page(
            &own.experiments,
            words(),
            open(Some(&own.name)),
            index.as_deref(),
        );
        (file.with_file_name(&own.file), page)
    });
    let first = compared::index(&chapters, words(), open(None));
    [(file.to_path_buf(), first)]
        .into_iter()
        .chain(each)
        .collect()
}

/// The chapter or appendix of an experiment, by the number of its figure; what has none is of the chapter that it is told in.
fn chapter(id: &str) -> String {
    match id.split_once('.') {
        Some((letter @ ("A" | "B" | "C"), _)) => format!("Appendix {letter}"),
        Some((number, _)) => format!("Chapter {number}"),
        None if id == "displays" => "Chapter 2".to_owned(),
        None => "Chapter 6".to_owned(),
    }
}

/// The file of a chapter's page, beside the index.
fn beside(index: &Path, chapter: &str) -> String {
    let stem = index.file_stem().unwrap_or_default().to_string_lossy();
    format!("{stem}-{}.html", chapter.to_lowercase().replace(' ', "-"))
}

fn again(out: &Path, Done { experiment, left }: &Done) -> Again {
    let statement = |own: &Finding| Statement {
        place: own.place.to_owned(),
        statement: own.statement.clone(),
        stated: own.stated.clone(),
        ours: own.ours.clone(),
        verdict: own.verdict.name(),
        because: match own.account {
            Some(account) => format!("{}, {account}", own.because),
            None => own.because.clone(),
        },
    };
    Again {
        id: experiment.id.to_owned(),
        title: experiment.title.to_owned(),
        what: experiment.what.to_owned(),
        statements: left.findings.iter().map(statement).collect(),
        pictures: left
            .pictures
            .iter()
            .map(|drawn| (drawn.name.clone(), picture::figure(drawn)))
            .collect(),
        files: left
            .tables
            .iter()
            .map(|table| out.join(experiment.id).join(&table.name))
            .map(|file| format!("{}.csv", file.display()))
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_experiment_belongs_to_a_chapter() {
        let chapters: Vec<String> = rigproof_experiments::all()
            .iter()
            .map(|own| chapter(own.id))
            .collect();
        let known = [
            "Chapter 2",
            "Chapter 3",
            "Chapter 4",
            "Chapter 5",
            "Chapter 6",
            "Appendix B",
        ];
        assert!(chapters.iter().all(|own| known.contains(&own.as_str())));
        assert_eq!(
            beside(Path::new("out/thesis.html"), "Appendix B"),
            "thesis-appendix-b.html"
        );
    }
}
