//! The address of a hangar.

use std::fmt;
use std::str::FromStr;

use crate::hangar::service::PORT;

/// A hangar's address: `http://HOST:PORT`.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct HangarAddress {
    /// A name or an address; IPv6 without its brackets.
    pub host: String,
    pub port: u16,
}

/// Why a text is not an address of a hangar.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HangarAddressError {
    /// The address begins with `https:`, which no hangar supports.
    #[error(
        "a hangar does not speak HTTPS: use `ssh -L {PORT}:127.0.0.1:{PORT} HOST` and http://127.0.0.1:{PORT}"
    )]
    Https,
    #[error("`{0}` is not the address of a hangar: expected http://HOST:PORT")]
    Other(String),
}

impl FromStr for HangarAddress {
    type Err = HangarAddressError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let other = || HangarAddressError::Other(text.to_owned());
        if text.starts_with("https:") {
            return Err(HangarAddressError::Https);
        }
        let place = text.strip_prefix("http://").ok_or_else(other)?;
        let rest = place.strip_suffix('/').unwrap_or(place);
        let (host, port) = match rest.strip_prefix('[') {
            Some(rest) => {
                let (host, after) = rest.split_once(']').ok_or_else(other)?;
                let port = match after {
                    "" => None,
                    after => Some(after.strip_prefix(':').ok_or_else(other)?),
                };
                (host, port)
            }
            None => match rest.split_once(':') {
                Some((host, port)) => (host, Some(port)),
                None => (rest, None),
            },
        };
        let is_name = |c: char| c.is_ascii_alphanumeric() || "-._:%".contains(c);
        if host.is_empty() || !host.chars().all(is_name) {
            return Err(other());
        }
        let port = port.map_or(Ok(PORT), str::parse).map_err(|_| other())?;
        let host = host.to_owned();
        Ok(Self { host, port })
    }
}

impl HangarAddress {
    /// `HOST:PORT`, as in the header `Host`.
    pub fn authority(&self) -> String {
        let Self { host, port } = self;
        if host.contains(':') {
            return format!("[{host}]:{port}");
        }
        format!("{host}:{port}")
    }
}

impl fmt::Display for HangarAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "http://{}", self.authority())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read_and_written() {
        for (text, authority) in [
            ("http://127.0.0.1:5700", "127.0.0.1:5700"),
            ("http://lab-1.example:80/", "lab-1.example:80"),
            ("http://lab1", "lab1:5700"),
            ("http://[::1]:81", "[::1]:81"),
            ("http://[::1]", "[::1]:5700"),
        ] {
            let address: HangarAddress = text.parse().expect(text);
            assert_eq!(address.authority(), authority);
            assert_eq!(address.to_string().parse(), Ok(address));
        }
        for text in [
            "",
            "lab1",
            "lab1:5700",
            "http://",
            "http://:5700",
            "http://lab1:x",
            "http://lab1:70000",
            "http://lab1:5700/vehicles",
            "http://user@lab1:5700",
            "http://[::1",
            "http://[::1]5700",
            "tcp:lab1:5700",
        ] {
            let error = text.parse::<HangarAddress>().expect_err(text);
            assert_eq!(error, HangarAddressError::Other(text.to_owned()));
        }
        let error = "https://lab1".parse::<HangarAddress>();
        assert_eq!(error, Err(HangarAddressError::Https));
    }
}
