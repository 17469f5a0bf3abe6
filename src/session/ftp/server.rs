//! A file server for tests, which behaves like `ArduPilot`'s except for its [`Quirks`].

use std::collections::{BTreeMap, VecDeque};

use super::packet::FtpPayload;

/// The maximum number of waiting requests; more are dropped.
const MOST_WAITING: usize = 5;
const BURST: usize = 500;
const PIECE: usize = 239;

/// How a server handles requests for checksums.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sums {
    #[default]
    Right,
    /// The server returns wrong checksums.
    Wrong,
    /// The server does not support the request.
    None,
}

/// How a server differs from `ArduPilot`'s.
#[derive(Debug, Clone, Default)]
pub struct Quirks {
    /// The server never answers.
    pub is_silent: bool,
    /// The server refuses bursts with this code.
    pub refuses_bursts: Option<u8>,
    /// The server ends a burst without a last packet that marks the end.
    pub ends_without_word: bool,
    /// The server assigns this session, whatever the client requests.
    pub session: Option<u8>,
    /// The server refuses to read at this offset or beyond.
    pub refuses_from: Option<usize>,
    /// The server reports files as longer than they are, by this many bytes.
    pub estimate: usize,
    /// The server closes the file after this many packets of data.
    pub forgets_after: Option<usize>,
    pub sums: Sums,
    /// Another client has a file open until this many requests have been refused.
    pub busy_for: usize,
}

/// The server of a vehicle.
#[derive(Debug, Clone, Default)]
pub struct FileServer {
    pub files: BTreeMap<String, Vec<u8>>,
    pub quirks: Quirks,
    /// The opcodes that were carried out.
    pub carried_out: Vec<u8>,
    open: Option<(u8, String)>,
    waiting: VecDeque<FtpPayload>,
    last: Option<FtpPayload>,
    burst: Option<(FtpPayload, usize)>,
    sent: usize,
}

impl FileServer {
    pub fn with(path: &str, content: &[u8]) -> Self {
        Self {
            files: BTreeMap::from([(path.to_owned(), content.to_vec())]),
            ..Self::default()
        }
    }

    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    pub fn hear(&mut self, request: FtpPayload) {
        if !self.quirks.is_silent && self.waiting.len() < MOST_WAITING {
            self.waiting.push_back(request);
        }
    }

    /// The next packet, if there is one.
    pub fn say(&mut self) -> Option<FtpPayload> {
        if let Some((request, index)) = self.burst.take() {
            return self.go_on(request, index);
        }
        let request = self.waiting.pop_front()?;
        let again = self.last.filter(|last| {
            let next = u16::from_le_bytes([request[0], request[1]]).wrapping_add(1);
            let is_same = self.quirks.session.is_some() || last[2] == request[2];
            last[..2] == next.to_le_bytes() && is_same
        });
        if again.is_some() {
            return again;
        }
        if self.quirks.busy_for > 0 {
            self.quirks.busy_for -= 1;
            return Some(self.answer(&request, 129, &[4]));
        }
        self.carried_out.push(request[3]);
        self.serve(&request)
    }

    fn serve(&mut self, request: &FtpPayload) -> Option<FtpPayload> {
        let offset = u32::from_le_bytes([request[8], request[9], request[10], request[11]]);
        let path = String::from_utf8_lossy(&request[12..12 + usize::from(request[4])]).into_owned();
        Some(match request[3] {
            1 | 2 => {
                self.open = None;
                self.answer(request, 128, &[])
            }
            3 => self.list(request, &path, offset as usize),
            4 => self.open(request, path),
            5 => self.read(request, offset as usize),
            14 => self.checksum(request, &path),
            15 => match self.quirks.refuses_bursts {
                Some(code) => self.answer(request, 129, &[code]),
                None => return self.go_on(*request, 0),
            },
            _ => self.answer(request, 129, &[1]),
        })
    }

    fn list(&mut self, request: &FtpPayload, folder: &str, first: usize) -> FtpPayload {
        let within = format!("{folder}/");
        let mut data = Vec::new();
        let names = self.files.iter().filter_map(|(path, content)| {
            let name = path.strip_prefix(&within)?;
            Some(format!("F{name}\t{}\0\0", content.len()))
        });
        let names: Vec<String> = names.collect();
        if names.is_empty() {
            return self.answer(request, 129, &[10]);
        }
        for name in names.iter().skip(first) {
            if data.len() + name.len() > PIECE {
                break;
            }
            data.extend_from_slice(name.as_bytes());
        }
        if data.is_empty() {
            return self.answer(request, 129, &[6]);
        }
        self.answer(request, 128, &data)
    }

    fn open(&mut self, request: &FtpPayload, path: String) -> FtpPayload {
        if self.open.is_some() {
            return self.answer(request, 129, &[1]);
        }
        let Some(content) = self.files.get(&path) else {
            return self.answer(request, 129, &[10]);
        };
        let size = (content.len() + self.quirks.estimate) as u32;
        self.open = Some((self.quirks.session.unwrap_or(request[2]), path));
        self.answer(request, 128, &size.to_le_bytes())
    }

    fn bytes(&mut self, session: u8, offset: usize, size: usize) -> Result<Vec<u8>, u8> {
        if self.quirks.forgets_after.is_some_and(|it| self.sent >= it) {
            self.quirks.forgets_after = None;
            self.open = None;
        }
        let (open, path) = self.open.as_ref().ok_or(10)?;
        if *open != session {
            return Err(4);
        }
        if self.quirks.refuses_from.is_some_and(|it| offset >= it) {
            return Err(1);
        }
        let content = self.files.get(path).ok_or(10)?;
        let rest = content.get(offset..).unwrap_or_default();
        let bytes = rest[..rest.len().min(size)].to_vec();
        self.sent += 1;
        if bytes.is_empty() { Err(6) } else { Ok(bytes) }
    }

    fn read(&mut self, request: &FtpPayload, offset: usize) -> FtpPayload {
        match self.bytes(request[2], offset, usize::from(request[4])) {
            Ok(bytes) => self.answer(request, 128, &bytes),
            Err(code) => self.answer(request, 129, &[code]),
        }
    }

    fn go_on(&mut self, request: FtpPayload, index: usize) -> Option<FtpPayload> {
        let size = usize::from(request[4]).max(1);
        let from = u32::from_le_bytes([request[8], request[9], request[10], request[11]]);
        let offset = from as usize + index * size;
        let mut numbered = request;
        let number = u16::from_le_bytes([request[0], request[1]]).wrapping_add(index as u16);
        numbered[..2].copy_from_slice(&number.to_le_bytes());
        numbered[8..12].copy_from_slice(&(offset as u32).to_le_bytes());
        match self.bytes(request[2], offset, size) {
            Ok(bytes) => {
                let is_last = index + 1 == BURST;
                numbered[6] = u8::from(is_last && !self.quirks.ends_without_word);
                self.burst = (!is_last).then_some((request, index + 1));
                Some(self.answer(&numbered, 128, &bytes))
            }
            Err(_) if self.quirks.ends_without_word && index > 0 => None,
            Err(code) => Some(self.answer(&numbered, 129, &[code])),
        }
    }

    fn checksum(&mut self, request: &FtpPayload, path: &str) -> FtpPayload {
        let Some(content) = self
            .files
            .get(path)
            .filter(|_| self.quirks.sums != Sums::None)
        else {
            return self.answer(request, 129, &[7]);
        };
        let mut sum = crate::wire::FtpChecksum::default();
        sum.add(content);
        let sum = sum.value() ^ u32::from(self.quirks.sums == Sums::Wrong);
        self.answer(request, 128, &sum.to_le_bytes())
    }

    fn answer(&mut self, request: &FtpPayload, opcode: u8, data: &[u8]) -> FtpPayload {
        let mut payload = [0; 251];
        let number = u16::from_le_bytes([request[0], request[1]]).wrapping_add(1);
        payload[..2].copy_from_slice(&number.to_le_bytes());
        payload[2] = self.quirks.session.unwrap_or(request[2]);
        payload[3..7].copy_from_slice(&[opcode, data.len() as u8, request[3], request[6]]);
        payload[8..12].copy_from_slice(&request[8..12]);
        payload[12..12 + data.len()].copy_from_slice(data);
        self.last = Some(payload);
        payload
    }
}
