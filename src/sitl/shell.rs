//! Command lines as a POSIX shell reads them.

use std::borrow::Cow;
use std::fmt::Write as _;

use super::CommandLine;

/// A word, quoted for a shell if necessary.
pub fn quoted(word: &str) -> Cow<'_, str> {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-+./:,=@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return Cow::Borrowed(word);
    }
    Cow::Owned(format!("'{}'", word.replace('\'', r"'\''")))
}

/// Words as one shell command line, quoted where necessary.
pub fn line<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let words: Vec<_> = words.into_iter().map(quoted).collect();
    words.join(" ")
}

impl CommandLine {
    /// The command line with its program, for a shell in the instance's folder.
    pub fn line(&self, program: &str) -> String {
        line(
            [program]
                .into_iter()
                .chain(self.arguments.iter().map(String::as_str)),
        )
    }

    /// The script that creates the instance's folder and its files.
    pub fn preparation(&self, folder: &str) -> String {
        let mut script = format!("mkdir -p {}\n", quoted(folder));
        for (name, text) in &self.files {
            let end = end_of(text);
            let newline = if text.ends_with('\n') { "" } else { "\n" };
            let path = format!("{folder}/{name}");
            // Writing to a string cannot fail.
            let _ = writeln!(
                script,
                "cat > {} <<'{end}'\n{text}{newline}{end}",
                quoted(&path)
            );
        }
        script
    }
}

/// A line that ends a here-document and does not occur in its text.
fn end_of(text: &str) -> String {
    let mut end = "END".to_owned();
    while text.lines().any(|line| line == end) {
        end.push('_');
    }
    end
}
