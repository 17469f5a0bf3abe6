//! Draws the pictures of the documents: a reference pilot flies a mission with a fixed seed, and screens of the console
//! are written as SVG.
//!
//! `cargo run --example screenshot`

use std::fs;
use std::path::Path;

mod film;
mod svg;

fn main() -> anyhow::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for picture in film::pictures(root)? {
        let path = root.join(picture.path);
        fs::write(&path, picture.svg)?;
        println!("{}", path.display());
    }
    Ok(())
}
