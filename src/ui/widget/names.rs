//! Names that are shortened to fit, and still differ.

use std::collections::BTreeSet;

use super::{clip, width};

/// The names within a width, shortened so that they differ: to their beginnings, otherwise to their
/// ends, otherwise to the part after their common beginning.
pub fn told_apart(names: &[String], columns: usize) -> Vec<String> {
    let is_long = |name: &&str| width(name) > columns;
    let all = names.iter().map(String::as_str);
    let common = common_start(&all.filter(is_long).collect::<Vec<_>>());
    let without_start = |name: &str, letters: usize| -> String {
        std::iter::once('…')
            .chain(name.chars().skip(letters))
            .collect()
    };
    let shortened = |cut: &dyn Fn(&str) -> String| -> Vec<String> {
        let shown = names.iter().map(|name| {
            if is_long(&name.as_str()) {
                cut(name)
            } else {
                name.clone()
            }
        });
        shown.collect()
    };
    let ends = |name: &str| {
        let kept = columns.saturating_sub(1);
        without_start(name, name.chars().count().saturating_sub(kept))
    };
    let mut ways = [shortened(&|name| clip(name, columns)), shortened(&ends)].into_iter();
    let rests = || shortened(&|name| clip(&without_start(name, common), columns));
    ways.find(|shown| differ(shown)).unwrap_or_else(rests)
}

fn differ(names: &[String]) -> bool {
    names.iter().collect::<BTreeSet<_>>().len() == names.len()
}

/// The number of letters with which all names begin.
fn common_start(names: &[&str]) -> usize {
    let Some((first, others)) = names.split_first() else {
        return 0;
    };
    let shared = |name: &&str| {
        let pairs = name.chars().zip(first.chars());
        pairs.take_while(|(a, b)| a == b).count()
    };
    others.iter().map(shared).min().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(names: &[&str], columns: usize) -> Vec<String> {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        told_apart(&names, columns)
    }

    #[test]
    fn names_are_shortened_only_if_needed_and_differ() {
        assert_eq!(shown(&["12", "north"], 6), ["12", "north"]);
        assert_eq!(shown(&["northern", "southern"], 6), ["north…", "south…"]);
        assert_eq!(
            shown(&["survey-north", "survey-south", "3"], 6),
            ["…north", "…south", "3"]
        );
        assert_eq!(
            shown(&["field-1-survey", "field-2-survey"], 6),
            ["…1-su…", "…2-su…"]
        );
        assert!(shown(&[], 6).is_empty());
    }
}
