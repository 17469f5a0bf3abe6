use super::*;

#[test]
fn every_kind_has_one_name() {
    let mut names: Vec<&str> = EvidenceKind::named().map(|(name, _)| name).collect();
    let all = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), all);
    for (name, kind) in EvidenceKind::named() {
        assert_eq!(EvidenceKind::by_name(name), Some(kind));
    }
}
