//! Prints the licences of all crates in the program, for the archives of a release.
//!
//! `cargo run --example third_party -- x86_64-unknown-linux-musl > THIRD-PARTY.md`
//!
//! Cargo lists the crates; the texts come from the crates' own packages.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, ensure};
use serde::Deserialize;

/// The name prefixes of licence files, in lower case.
const LICENCE_FILES: [&str; 6] = [
    "license",
    "licence",
    "copying",
    "unlicense",
    "copyright",
    "notice",
];

/// The parts of the output of `cargo metadata` that are used.
#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
    /// The ids of the program and its libraries.
    workspace_members: BTreeSet<String>,
    resolve: Resolve,
}

#[derive(Deserialize)]
struct Package {
    id: String,
    name: String,
    version: String,
    license: Option<String>,
    #[serde(default)]
    authors: Vec<String>,
    repository: Option<String>,
    manifest_path: String,
}

#[derive(Deserialize)]
struct Resolve {
    nodes: Vec<Node>,
    /// The package of the program.
    root: String,
}

#[derive(Deserialize)]
struct Node {
    id: String,
    deps: Vec<Dependency>,
}

#[derive(Deserialize)]
struct Dependency {
    pkg: String,
    dep_kinds: Vec<DependencyKind>,
}

#[derive(Deserialize)]
struct DependencyKind {
    /// `dev` or `build`; `None` for a dependency that becomes part of the program.
    kind: Option<String>,
}

fn main() -> anyhow::Result<()> {
    let target = std::env::args().nth(1);
    let metadata = metadata(target.as_deref())?;
    let inside = inside(&metadata.resolve);
    let packages = metadata.packages.iter();
    let mut foreign: Vec<&Package> = packages
        .filter(|package| !metadata.workspace_members.contains(&package.id))
        .filter(|package| inside.contains(package.id.as_str()))
        .collect();
    foreign.sort_by_key(|package| (&package.name, &package.version));
    print_document(&foreign, target.as_deref())
}

fn metadata(target: Option<&str>) -> anyhow::Result<Metadata> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["metadata", "--format-version", "1", "--locked"]);
    if let Some(target) = target {
        cargo.args(["--filter-platform", target]);
    }
    let output = cargo.output().context("cargo does not run")?;
    ensure!(
        output.status.success(),
        "cargo metadata: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// The ids of the packages that become part of the program.
fn inside(resolve: &Resolve) -> BTreeSet<&str> {
    let nodes = resolve.nodes.iter();
    let nodes: BTreeMap<&str, &Node> = nodes.map(|node| (node.id.as_str(), node)).collect();
    let mut found = BTreeSet::new();
    let mut open = vec![resolve.root.as_str()];
    while let Some(id) = open.pop() {
        if found.insert(id) {
            let deps = nodes[id].deps.iter();
            let normal = deps.filter(|dep| dep.dep_kinds.iter().any(|it| it.kind.is_none()));
            open.extend(normal.map(|dep| dep.pkg.as_str()));
        }
    }
    found
}

/// Prints a list of the packages, and each licence text once, below the packages that have it.
fn print_document(packages: &[&Package], target: Option<&str>) -> anyhow::Result<()> {
    println!("# Third-party software in sortie\n");
    println!(
        "The program also contains Rust's standard library ([its notices](licences/rust-std.html)){}.\n",
        c_library(target.unwrap_or_default())
    );
    println!("| package | version | licence | source |\n| --- | --- | --- | --- |");
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for package in packages {
        let name = format!("{} {}", package.name, package.version);
        println!(
            "| {} | {} | {} | {} |",
            package.name,
            package.version,
            package.license.as_deref().unwrap_or("see below"),
            package.repository.as_deref().unwrap_or_default()
        );
        for text in licences(package)? {
            texts.entry(text).or_default().push(name.clone());
        }
    }
    for (text, names) in texts {
        println!("\n## {}\n\n```\n{}\n```", names.join(", "), text.trim_end());
    }
    Ok(())
}

/// The C library in a static program for Linux.
fn c_library(target: &str) -> &'static str {
    if target.ends_with("-musl") {
        " and the C library musl ([its notices](licences/musl.txt))"
    } else if target.ends_with("-linux-gnu") {
        ", and a static one the C library glibc (LGPL 2.1 or later, [its notices](licences/glibc.txt)), which can be \
         replaced by building the commit named in `BUILD` with another version of it"
    } else {
        ""
    }
}

/// The licence texts of a package; if it contains none, the text of the MIT licence with the names
/// of its authors.
fn licences(package: &Package) -> anyhow::Result<Vec<String>> {
    let folder = Path::new(&package.manifest_path).parent();
    let folder = folder.context("a manifest is in a folder")?;
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().to_lowercase();
        let is_licence = LICENCE_FILES.iter().any(|begin| name.starts_with(begin));
        if is_licence && entry.file_type()?.is_file() {
            paths.push(entry.path());
        }
    }
    paths.sort();
    if paths.is_empty() {
        return Ok(vec![usual_text(package)?]);
    }
    let texts = paths.into_iter().map(|path| {
        let bytes = fs::read(path)?;
        Ok(String::from_utf8_lossy(&bytes).replace("\r\n", "\n"))
    });
    texts.collect()
}

/// The text of the MIT licence, under which a package without a licence file can be used.
fn usual_text(package: &Package) -> anyhow::Result<String> {
    let licence = package.license.as_deref().unwrap_or_default();
    ensure!(
        licence.contains("MIT"),
        "{} has no licence file, and its licence is not MIT: {licence}",
        package.name
    );
    // The licence of this program, without its copyright line.
    let own = include_str!("../LICENSE");
    let terms = own.find("Permission is hereby granted");
    let terms = terms.context("LICENSE is not that of MIT")?;
    let authors = match package.authors.as_slice() {
        [] => format!("the authors of {}", package.name),
        named => named.join(", "),
    };
    let terms = &own[terms..];
    Ok(format!(
        "{licence}\n\nMIT License\n\nCopyright (c) {authors}\n\n{terms}"
    ))
}
