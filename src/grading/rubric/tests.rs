use super::*;

const NOTECHS: &str = include_str!("../../../rubrics/notechs.toml");

/// The texts of all faults of the shipped rubric after a change.
fn faults(from: &str, to: &str) -> Vec<String> {
    assert!(NOTECHS.contains(from), "{from}");
    let faults = Rubric::parse("notechs", &NOTECHS.replacen(from, to, 1)).expect_err("faulty");
    faults.iter().map(|it| it.message.to_string()).collect()
}

#[test]
fn the_shipped_rubric_has_four_categories_in_two_languages() {
    let rubric = Rubric::parse("notechs", NOTECHS).expect("it is good");
    assert_eq!(rubric.categories.len(), 4);
    assert_eq!(rubric.elements().count(), 11);
    assert_eq!(rubric.untranslated, []);
    assert!(rubric.elements().all(|it| !it.evidence.is_empty()));
}

#[test]
fn faults_are_named_with_their_places() {
    assert_eq!(
        faults("schema = 1", "schema = 2"),
        ["unknown schema 2: this version reads schema 1"]
    );
    assert_eq!(
        faults("id = \"planning\"", "id = \"Planning\""),
        ["an id has 1 to 24 lowercase letters, digits and `-`"]
    );
    assert_eq!(
        faults("id = \"planning\"", "id = \"leadership\""),
        ["`leadership` is used twice"]
    );
    assert_eq!(
        faults("\"idle\", \"commands\", \"time\"", "\"idel\""),
        ["unknown evidence `idel`"]
    );
    let poor = "poor = [\"Flies into known danger\"]";
    assert_eq!(
        faults(poor, "poor = []"),
        [
            "list what can be observed: at least one text",
            "translations: 1, texts: 0"
        ]
    );
}

#[test]
fn too_few_categories_are_a_fault() {
    let last = NOTECHS.rfind("[[categories]]").expect("several");
    let faults = Rubric::parse("short", &NOTECHS[..last]).expect_err("three are left");
    assert_eq!(
        faults[0].message.to_string(),
        "3 categories: a rubric has four to six"
    );
}

/// Damaged files are refused or read, but never end the program.
#[test]
fn damaged_rubrics_are_read_or_refused() {
    let mut seed = 1_u64;
    for _ in 0..300 {
        let mut text: Vec<char> = NOTECHS.chars().collect();
        for _ in 0..3 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let at = (seed >> 33) as usize % text.len();
            match seed >> 62 {
                0 => drop(text.remove(at)),
                1 => text.insert(at, '"'),
                2 => text[at] = '[',
                _ => text.truncate(at.max(1)),
            }
        }
        let text: String = text.into_iter().collect();
        if let Err(faults) = Rubric::parse("damaged", &text) {
            assert!(faults.iter().all(|it| it.span.end <= text.len()), "{text}");
        }
    }
}
