//! The pictures in the documents match the program's screens.

#[path = "../../examples/screenshot/film.rs"]
mod film;
#[path = "../../examples/screenshot/svg.rs"]
mod svg;

/// Skipped on other platforms: the last digits of a flight may differ with the mathematics library.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[test]
fn the_pictures_are_current() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    for picture in film::pictures(root).expect("the mission flies") {
        let kept = std::fs::read_to_string(root.join(picture.path)).unwrap_or_default();
        let is_current = kept == picture.svg;
        assert!(
            is_current,
            "{} shows an older program: cargo run --example screenshot",
            picture.path
        );
    }
}
