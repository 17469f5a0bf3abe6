//! What a trainee gets to join a class on several machines.

use std::fmt;

use ct_codecs::{Base64UrlSafeNoPadding, Decoder as _, Encoder as _};
use sha2::{Digest as _, Sha256};
use thiserror::Error;

/// How a join line begins.
const PREFIX: &str = "sortie-join/1/";
/// How the name of a file with a join line ends.
pub(crate) const ENDING: &str = ".join";
/// The maximum length of a join line.
const LONGEST: usize = 8 * 1024;

/// The number of bytes of its check.
const CHECK: usize = 6;

/// What one seat needs to reach its desk: a secret of this seat.
#[derive(Clone, PartialEq, Eq)]
pub struct JoinLine {
    /// The name of the class.
    pub class: String,
    /// The name of the seat, which is also that of its certificate.
    pub seat: String,
    /// Where the desk listens, each as HOST:PORT. The first one that answers is used.
    pub addresses: Vec<String>,
    /// The secret key of the seat (PKCS #8).
    pub key: Vec<u8>,
    /// The certificate of the seat (DER).
    pub certificate: Vec<u8>,
    /// The certificate of the desk (DER), the only one that the seat trusts.
    pub desk_certificate: Vec<u8>,
    /// The public key with which the desk signs.
    pub desk_key: Vec<u8>,
}

/// Why a text is not a join line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum JoinLineFault {
    #[error("it does not begin with {PREFIX}")]
    Prefix,
    #[error("a part of it is missing")]
    Incomplete,
    #[error("a part of it is damaged")]
    Damaged,
}

/// A name that can be a part of a key and of a path.
pub(crate) fn is_name(text: &str) -> bool {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
    !text.is_empty() && text.len() <= 64 && text.chars().all(is_plain)
}

/// Whether a text has the form HOST:PORT.
pub(crate) fn is_address(text: &str) -> bool {
    let is_host = |c: char| c.is_ascii_alphanumeric() || "-_.:[]".contains(c);
    text.rsplit_once(':').is_some_and(|(host, port)| {
        let is_bracketed = host.starts_with('[') && host.ends_with(']');
        let is_plain = !host.is_empty() && host.chars().all(is_host);
        is_plain && (is_bracketed || !host.contains(':')) && port.parse::<u16>().is_ok()
    })
}

impl JoinLine {
    /// Whether a text is meant as a join line.
    pub fn is_meant(text: &str) -> bool {
        text.trim_start().starts_with(PREFIX)
    }

    /// Reads a join line.
    ///
    /// # Errors
    /// The text is not a whole join line.
    pub fn parse(text: &str) -> Result<Self, JoinLineFault> {
        let text = text.trim();
        let parts = text.strip_prefix(PREFIX).ok_or(JoinLineFault::Prefix)?;
        let parts: Vec<&str> = parts.split('/').collect();
        let &[
            class,
            seat,
            addresses,
            key,
            certificate,
            desk_certificate,
            desk_key,
            check,
        ] = &parts[..]
        else {
            return Err(JoinLineFault::Incomplete);
        };
        let addresses: Vec<String> = addresses.split(',').map(str::to_owned).collect();
        let content = text.strip_suffix(check).unwrap_or(text);
        let is_whole = check == check_of(content)
            && is_name(class)
            && is_name(seat)
            && addresses.iter().all(|it| is_address(it));
        if !is_whole || text.len() > LONGEST {
            return Err(JoinLineFault::Damaged);
        }
        Ok(Self {
            class: class.to_owned(),
            seat: seat.to_owned(),
            addresses,
            key: decoded(key)?,
            certificate: decoded(certificate)?,
            desk_certificate: decoded(desk_certificate)?,
            desk_key: decoded(desk_key)?,
        })
    }

    /// The line as a trainee pastes it. It contains the secret key.
    pub fn secret_text(&self) -> String {
        let parts = [
            self.class.clone(),
            self.seat.clone(),
            self.addresses.join(","),
            encoded(&self.key),
            encoded(&self.certificate),
            encoded(&self.desk_certificate),
            encoded(&self.desk_key),
        ];
        let content = format!("{PREFIX}{}/", parts.join("/"));
        let check = check_of(&content);
        content + &check
    }

    /// The class and the seat as one text, for files that say to which class a record belongs. Two classes of the same
    /// name have different keys.
    pub fn id(&self) -> String {
        let (class, seat) = (&self.class, &self.seat);
        format!("{PREFIX}{class}/{seat}/{}", encoded(&self.desk_key))
    }
}

/// Without the secret key.
impl fmt::Debug for JoinLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("JoinLine")
            .field("class", &self.class)
            .field("seat", &self.seat)
            .field("addresses", &self.addresses)
            .finish_non_exhaustive()
    }
}

/// The last part of a join line, which shows whether the others are as they were written.
fn check_of(content: &str) -> String {
    let hash = Sha256::digest(content.as_bytes());
    encoded(hash.as_slice().split_at(CHECK).0)
}

fn encoded(bytes: &[u8]) -> String {
    // Only a text longer than the address space cannot be encoded.
    Base64UrlSafeNoPadding::encode_to_string(bytes).unwrap_or_default()
}

fn decoded(text: &str) -> Result<Vec<u8>, JoinLineFault> {
    let bytes = Base64UrlSafeNoPadding::decode_to_vec(text, None);
    let bytes = bytes.map_err(|_| JoinLineFault::Damaged)?;
    if bytes.is_empty() {
        return Err(JoinLineFault::Damaged);
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line() -> JoinLine {
        JoinLine {
            class: "9-A".to_owned(),
            seat: "seat-07".to_owned(),
            addresses: vec!["10.0.0.5:7447".to_owned(), "[::1]:7447".to_owned()],
            key: vec![1; 83],
            certificate: vec![2; 330],
            desk_certificate: vec![3; 300],
            desk_key: vec![4; 32],
        }
    }

    #[test]
    fn a_line_is_read_as_it_was_written_also_with_spaces_around_it() {
        let text = line().secret_text();
        assert!(JoinLine::is_meant(&text));
        assert_eq!(JoinLine::parse(&format!(" {text}\n")), Ok(line()));
        assert!(text.len() < 1500, "it can be pasted: {}", text.len());
    }

    #[test]
    fn a_text_that_is_no_whole_line_is_refused() {
        let text = line().secret_text();
        let cut = text.rsplit_once('/').expect("parts").0;
        let half = text.split_at(text.len() / 2).0;
        let mut no_class = line();
        no_class.class = "*".to_owned();
        let mut no_address = line();
        no_address.addresses = vec!["lab".to_owned()];
        for (wrong, fault) in [
            ("", JoinLineFault::Prefix),
            ("/tmp/class", JoinLineFault::Prefix),
            (cut, JoinLineFault::Incomplete),
            (half, JoinLineFault::Incomplete),
            (&text.replace("9-A", "9/A"), JoinLineFault::Incomplete),
            (&text[..text.len() - 1], JoinLineFault::Damaged),
            (&no_class.secret_text(), JoinLineFault::Damaged),
            (&no_address.secret_text(), JoinLineFault::Damaged),
        ] {
            assert_eq!(JoinLine::parse(wrong), Err(fault), "{wrong}");
        }
    }

    #[test]
    fn a_line_with_one_wrong_character_is_refused() {
        let text = line().secret_text();
        for (at, was) in text.char_indices() {
            let other = if was == 'B' { "C" } else { "B" };
            let mut wrong = text.clone();
            wrong.replace_range(at..=at, other);
            assert!(JoinLine::parse(&wrong).is_err(), "character {at}");
        }
    }

    #[test]
    fn neither_debug_output_nor_the_id_has_the_key() {
        let shown = format!("{:?} {}", line(), line().id());
        assert!(!shown.contains(&encoded(&line().key)) && !shown.contains("1, 1, 1"));
    }
}
