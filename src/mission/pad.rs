//! The names of pads in commands.

/// The prefix of the pads' names; a number follows.
pub(crate) const STEM: &str = "pad";

/// The name of a pad; the first has the number 1.
pub(crate) fn pad_name(number: usize) -> String {
    format!("{STEM}{number}")
}

/// Whether a name is that of a pad.
pub fn is_pad(name: &str) -> bool {
    name.strip_prefix(STEM)
        .is_some_and(|number| number.chars().all(|c| c.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_paddock_is_no_pad() {
        assert!(is_pad(&pad_name(12)) && is_pad("pad"));
        assert!(!is_pad("paddock") && !is_pad("c1"));
    }
}
