//! This file writes commands that a person can paste into a shell.

use std::path::Path;

/// A command with its options; an option without a name is a plain argument.
pub fn line(command: &[&str], options: &[(&str, &Path)]) -> String {
    let mut words: Vec<String> = command.iter().map(|word| (*word).to_owned()).collect();
    for (name, value) in options {
        words.extend((!name.is_empty()).then(|| (*name).to_owned()));
        words.push(quoted(&value.display().to_string()));
    }
    words.join(" ")
}

/// A word that a POSIX shell takes as it is.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "_-./+,:@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_with_spaces_or_quotes_are_kept_together() {
        let options = [
            ("", Path::new("run 3.csv")),
            ("--rig", Path::new("lab/axis.toml")),
            ("--out", Path::new("it's")),
        ];
        assert_eq!(
            line(&["rigproof", "diagnose"], &options),
            r"rigproof diagnose 'run 3.csv' --rig lab/axis.toml --out 'it'\''s'"
        );
    }
}
