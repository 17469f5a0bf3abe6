//! `sortie bench scale` with the embedded simulator: whether its figures are right, not how fast it is.

use std::process::Command;

#[test]
fn vehicles_that_fly_are_measured_in_one_document_and_drawn() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let drawing = folder.path().join("scale.svg");
    let output = Command::new(env!("CARGO_BIN_EXE_sortie"))
        .args(["bench", "scale", "--counts", "0,2", "--seconds", "1"])
        .args(["--repeat", "1", "--spacing", "3", "--json", "--svg"])
        .arg(&drawing)
        .output()
        .expect("it starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let rows: serde_json::Value = serde_json::from_slice(&output.stdout).expect("one document");
    assert_eq!(rows.as_array().map(Vec::len), Some(2));
    let (none, two) = (&rows[0], &rows[1]);
    assert_eq!(
        (&none["vehicles"], &two["vehicles"]),
        (&0.into(), &2.into())
    );
    assert!(none["realtime_factor"].is_null() && none["model_percent_per_vehicle"].is_null());
    for field in [
        "window_s",
        "sim_cpu_ms",
        "sim_core_percent",
        "sim_core_percent_per_vehicle",
        "model_ms",
        "model_percent",
        "model_percent_per_vehicle",
        "realtime_factor",
        "messages_per_s",
    ] {
        assert!(
            two[field].as_f64().is_some_and(|x| x > 0.0),
            "{field}: {two}"
        );
    }
    assert!(two["window_s"].as_f64().is_some_and(|s| s >= 1.0), "{two}");
    let each = two["sim_core_percent_per_vehicle"].as_f64();
    let all = two["sim_core_percent"].as_f64();
    assert!(
        each.zip(all)
            .is_some_and(|(each, all)| (2.0 * each / all - 1.0).abs() < 1e-6),
        "{two}"
    );
    // No vehicle may have stood still.
    assert_eq!(two["void"], serde_json::json!([]));
    assert!(
        said.contains("2 vehicles, repeat 1 of 1: measuring"),
        "{said}"
    );
    let drawn = std::fs::read_to_string(&drawing).expect("it was drawn");
    assert!(drawn.starts_with("<svg") && drawn.trim_end().ends_with("</svg>"));
}

#[test]
fn what_cannot_be_measured_is_said_before_anything_is() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let drawing = folder.path().join("earlier.svg");
    std::fs::write(&drawing, "earlier").expect("it is written");
    let drawing = drawing.to_str().expect("it has a plain name");
    let cases: [(&[&str], &[&str]); 4] = [
        (
            &["--arducopter", "nowhere/arducopter"],
            &["nowhere/arducopter"],
        ),
        (&["--svg", "nowhere/at/all.svg"], &["nowhere/at/all.svg"]),
        // A program that is not an autopilot is reported before any vehicle is started.
        (
            &["--arducopter", "/bin/cat", "--svg", drawing],
            &["/bin/cat"],
        ),
        (&["--counts", "1,20000"], &["20000"]),
    ];
    for (arguments, words) in cases {
        let output = Command::new(env!("CARGO_BIN_EXE_sortie"))
            .args(["bench", "scale"])
            .args(arguments)
            .env("XDG_STATE_HOME", folder.path())
            .output()
            .expect("it starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        for word in words {
            assert!(
                said.contains(word),
                "{arguments:?} does not say {word:?}: {said}"
            );
        }
    }
    let kept = std::fs::read_to_string(drawing).expect("it is there");
    assert_eq!(
        kept, "earlier",
        "an earlier drawing stays until there is another"
    );
}
