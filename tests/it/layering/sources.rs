//! The modules of the workspace and the paths that their code names, read from the sources.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The code of a module's own file, without comments, literals and code that is compiled for tests only.
#[derive(Debug)]
pub(super) struct ModuleSource {
    /// The crate, as code names it.
    pub package: String,
    /// The path from the crate's root; empty for the root.
    pub path: Vec<String>,
    /// The file, relative to the workspace's root.
    pub file: String,
    pub code: String,
}

/// All modules that are not for tests only: those of `src`, then those of `crates/*/src`.
pub(super) fn modules() -> Vec<ModuleSource> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    read_crate(root, "src", "sortie", &mut found);
    let crates = fs::read_dir(root.join("crates"));
    let names = crates.into_iter().flatten().flatten();
    let mut names: Vec<String> = names
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    for name in names {
        let package = package_name(&root.join("crates").join(&name));
        read_crate(root, &format!("crates/{name}/src"), &package, &mut found);
    }
    found
}

fn package_name(folder: &Path) -> String {
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).expect("a package");
    let manifest: toml::Table = manifest.parse().expect("TOML");
    let name = manifest["package"]["name"].as_str().expect("a name");
    name.replace('-', "_")
}

fn read_crate(root: &Path, folder: &str, package: &str, found: &mut Vec<ModuleSource>) {
    let is_root = |file: &str| file == format!("{folder}/lib.rs");
    let mut files = Vec::new();
    list(root, folder, &mut files);
    let mut for_tests = BTreeSet::new();
    let mut modules = Vec::new();
    for file in files {
        // The program's `main` is a separate crate.
        if file == format!("{folder}/main.rs") {
            continue;
        }
        let inner = &file[folder.len() + 1..file.len() - ".rs".len()];
        let path: Vec<String> = if is_root(&file) {
            Vec::new()
        } else {
            inner.split('/').map(str::to_owned).collect()
        };
        let text = fs::read_to_string(root.join(&file)).expect("readable");
        let (code, test_modules) = without_tests(&blanked(&text));
        for_tests.extend(test_modules.into_iter().map(|name| below(&path, name)));
        modules.push(ModuleSource {
            package: package.to_owned(),
            path,
            file,
            code,
        });
    }
    let is_for_tests =
        |path: &[String]| (1..=path.len()).any(|len| for_tests.contains(&path[..len]));
    modules.retain(|module| !is_for_tests(&module.path));
    found.extend(modules);
}

fn list(root: &Path, folder: &str, files: &mut Vec<String>) {
    let entries = fs::read_dir(root.join(folder)).expect("readable");
    for entry in entries.flatten() {
        let name = format!("{folder}/{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            list(root, &name, files);
        } else if entry
            .path()
            .extension()
            .is_some_and(|ending| ending == "rs")
        {
            files.push(name);
        }
    }
    files.sort();
}

fn below(path: &[String], name: String) -> Vec<String> {
    path.iter().cloned().chain([name]).collect()
}

/// The code with blanks in place of comments and literals.
pub(super) fn blanked(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let len = match first {
            '/' | '"' | '\'' | 'r' => opaque_len(rest, code.chars().next_back()),
            _ => 0,
        };
        if len == 0 {
            code.push(first);
            rest = &rest[first.len_utf8()..];
        } else {
            let kept = |c: char| if c == '\n' { '\n' } else { ' ' };
            code.extend(rest[..len].chars().map(kept));
            rest = &rest[len..];
        }
    }
    code
}

/// The length of a comment or a literal at the beginning, in bytes; 0 without one.
fn opaque_len(text: &str, before: Option<char>) -> usize {
    let is_in_word = before.is_some_and(|c| c.is_alphanumeric() || c == '_');
    if text.starts_with("//") {
        return text.find('\n').unwrap_or(text.len());
    }
    if text.starts_with("/*") {
        return text.find("*/").map_or(text.len(), |at| at + 2);
    }
    if text.starts_with('"') {
        return quoted_len(text, '"');
    }
    if text.starts_with('\'') {
        // A lifetime has no closing quote after its first character.
        let mut chars = text.chars().skip(1);
        let (first, second) = (chars.next(), chars.next());
        let is_literal = first == Some('\\') || second == Some('\'');
        return if is_literal {
            quoted_len(text, '\'')
        } else {
            0
        };
    }
    if !is_in_word && (text.starts_with("r\"") || text.starts_with("r#")) {
        let hashes = text[1..].chars().take_while(|&c| c == '#').count();
        let end = format!("\"{}", "#".repeat(hashes));
        let body = 2 + hashes;
        if text[1 + hashes..].starts_with('"') {
            return text[body..]
                .find(&end)
                .map_or(text.len(), |at| body + at + end.len());
        }
    }
    0
}

fn quoted_len(text: &str, quote: char) -> usize {
    let mut is_escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        if c == quote && !is_escaped {
            return at + 1;
        }
        is_escaped = c == '\\' && !is_escaped;
    }
    text.len()
}

const FOR_TESTS: &str = "#[cfg(test)]";

/// The code without items for tests only, and the names of the test modules that have separate files.
pub(super) fn without_tests(code: &str) -> (String, Vec<String>) {
    let mut kept = String::new();
    let mut modules = Vec::new();
    let mut rest = code;
    while let Some(at) = rest.find(FOR_TESTS) {
        kept.push_str(&rest[..at]);
        let item = &rest[at + FOR_TESTS.len()..];
        let end = item.find([';', '{']).unwrap_or(item.len());
        let is_block = item[end..].starts_with('{');
        if !is_block && let Some((_, name)) = item[..end].rsplit_once("mod ") {
            modules.push(name.trim().to_owned());
        }
        let len = if is_block {
            end + group_len(&item[end..])
        } else {
            (end + 1).min(item.len())
        };
        rest = &item[len..];
    }
    kept.push_str(rest);
    (kept, modules)
}

/// The length of a group in braces, including them.
fn group_len(text: &str) -> usize {
    let mut depth = 0;
    for (at, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + 1;
        }
    }
    text.len()
}

/// Every path in some code that begins with one of these words; groups of imports are expanded.
pub(super) fn paths(code: &str, roots: &[&str]) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for root in roots {
        for (at, _) in code.match_indices(&format!("{root}::")) {
            let is_in_word =
                code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':');
            if !is_in_word {
                follow(&code[at..], &[], &mut found);
            }
        }
    }
    found
}

/// Reads a path, or a group of paths, that continues `head`.
fn follow(text: &str, head: &[String], found: &mut Vec<Vec<String>>) {
    let mut path = head.to_vec();
    let mut rest = text.trim_start();
    loop {
        if rest.starts_with('{') {
            let inner = &rest[1..group_len(rest) - 1];
            for part in parts(inner) {
                follow(part, &path, found);
            }
            return;
        }
        let end = rest
            .find(|c: char| !c.is_alphanumeric() && c != '_')
            .unwrap_or(rest.len());
        if end > 0 {
            path.push(rest[..end].to_owned());
        }
        match rest[end..].strip_prefix("::") {
            Some(more) if end > 0 => rest = more.trim_start(),
            _ => break,
        }
    }
    found.push(path);
}

/// The parts of a group, separated by commas outside of inner groups.
fn parts(group: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let (mut depth, mut from) = (0, 0);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                found.push(&group[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    found.push(&group[from..]);
    found.retain(|part| !part.trim().is_empty());
    found
}

/// For each parent module, the uses between its children, each with a file in which it occurs.
/// Parents are written `sortie` and `sortie::link`.
pub(super) type Uses = BTreeMap<String, BTreeMap<(String, String), String>>;

/// The uses between neighbouring modules, in the whole workspace.
pub(super) fn uses(modules: &[ModuleSource]) -> Uses {
    let known: BTreeSet<(&str, &[String])> = modules
        .iter()
        .map(|module| (module.package.as_str(), module.path.as_slice()))
        .collect();
    let mut found = Uses::new();
    for module in modules {
        for path in paths(&module.code, &["crate", "super", "self"]) {
            let Some(mut target) = resolved(&module.path, &path) else {
                continue;
            };
            while !target.is_empty()
                && !known.contains(&(module.package.as_str(), target.as_slice()))
            {
                target.pop();
            }
            let shared = module.path.iter().zip(&target);
            let shared = shared.take_while(|(here, there)| here == there).count();
            if let (Some(here), Some(there)) = (module.path.get(shared), target.get(shared)) {
                let parent = [
                    std::slice::from_ref(&module.package),
                    &module.path[..shared],
                ]
                .concat();
                found
                    .entry(parent.join("::"))
                    .or_default()
                    .entry((here.clone(), there.clone()))
                    .or_insert_with(|| module.file.clone());
            }
        }
    }
    found
}

/// The path from the crate's root that a path in a module stands for.
fn resolved(here: &[String], path: &[String]) -> Option<Vec<String>> {
    let (first, mut rest) = path.split_first()?;
    let mut at = match first.as_str() {
        "crate" => Vec::new(),
        "self" => here.to_vec(),
        _ => here.split_last()?.1.to_vec(),
    };
    while let Some(("super", more)) = rest.split_first().map(|(word, more)| (word.as_str(), more)) {
        at.pop()?;
        rest = more;
    }
    at.extend_from_slice(rest);
    Some(at)
}
