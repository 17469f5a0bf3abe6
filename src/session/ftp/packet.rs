//! The payload of `FILE_TRANSFER_PROTOCOL`. Source: <https://mavlink.io/en/services/ftp.html>.

use super::fault::FtpNak;

/// The field `payload` of `FILE_TRANSFER_PROTOCOL`.
pub type FtpPayload = [u8; 251];

/// The maximum number of bytes of data in one packet.
pub(super) const MOST_DATA: usize = 239;
const HEADER: usize = 12;
const ACCEPTED: u8 = 128;
const REFUSED: u8 = 129;

/// The requests that the client uses, with their numbers in the protocol.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum FtpOpcode {
    Terminate = 1,
    Reset = 2,
    List = 3,
    OpenToRead = 4,
    Read = 5,
    Create = 6,
    Write = 7,
    RemoveFile = 8,
    MakeFolder = 9,
    RemoveFolder = 10,
    Checksum = 14,
    Burst = 15,
}

/// A request to a vehicle's file server.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FtpRequest {
    /// The request's number among the console's requests; packets carry its lower 16 bits.
    pub sequence: u32,
    pub session: u8,
    pub opcode: FtpOpcode,
    pub offset: u32,
    /// The length of `data`, or the number of bytes to read.
    pub size: u8,
    pub data: Vec<u8>,
}

impl FtpRequest {
    /// A request about a path, from offset 0 of its file or folder.
    pub fn about(path: &str, opcode: FtpOpcode, session: u8, sequence: &mut FtpSequence) -> Self {
        Self {
            sequence: sequence.next(),
            session,
            opcode,
            offset: 0,
            size: path.len() as u8,
            data: path.as_bytes().to_vec(),
        }
    }

    pub fn payload(&self) -> FtpPayload {
        let mut payload = [0; HEADER + MOST_DATA];
        payload[..2].copy_from_slice(&(self.sequence as u16).to_le_bytes());
        payload[2..5].copy_from_slice(&[self.session, self.opcode as u8, self.size]);
        payload[8..HEADER].copy_from_slice(&self.offset.to_le_bytes());
        payload[HEADER..HEADER + self.data.len()].copy_from_slice(&self.data);
        payload
    }
}

/// An answer of a vehicle's file server.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FtpAnswer {
    pub sequence: u16,
    pub session: u8,
    /// The opcode of the request.
    pub asked: u8,
    pub is_burst_complete: bool,
    pub offset: u32,
    pub result: Result<Vec<u8>, FtpNak>,
}

impl FtpAnswer {
    /// Reads a payload; `None` if it is not an answer, or claims more data than it has room for.
    pub fn read(payload: &FtpPayload) -> Option<Self> {
        let size = usize::from(payload[4]);
        let data = payload.get(HEADER..HEADER + size)?;
        let result = match payload[3] {
            ACCEPTED => Ok(data.to_vec()),
            REFUSED => Err(FtpNak::read(data)),
            _ => return None,
        };
        Some(Self {
            sequence: u16::from_le_bytes([payload[0], payload[1]]),
            session: payload[2],
            asked: payload[5],
            is_burst_complete: payload[6] != 0,
            offset: u32::from_le_bytes([payload[8], payload[9], payload[10], payload[11]]),
            result,
        })
    }

    pub fn is_of(&self, opcode: FtpOpcode) -> bool {
        self.asked == opcode as u8
    }
}

/// The numbers of requests.
///
/// An answer has the number after that of its request, and the further answers of a burst count on
/// from there. `ArduPilot` repeats its last answer if a request has the number before that answer,
/// so numbers that a burst may have used are skipped.
#[derive(Debug, Clone, Default)]
pub(super) struct FtpSequence {
    last: u32,
}

/// The numbers reserved for a burst: `ArduPilot` sends 500 packets at most.
const BURST_ROOM: u32 = 1024;

impl FtpSequence {
    pub fn next(&mut self) -> u32 {
        self.last = self.last.wrapping_add(1);
        self.last
    }

    /// Skips the numbers that the answers of a burst may use.
    pub fn pass_over_burst(&mut self) {
        self.last = self.last.wrapping_add(BURST_ROOM);
    }

    /// The number of the request that an answer belongs to: the nearest one with the same lower bits.
    pub fn request_of(&self, answer: u16) -> u32 {
        let request = answer.wrapping_sub(1);
        let behind = (self.last as u16).wrapping_sub(request) as i16;
        self.last.wrapping_sub(i32::from(behind) as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_is_packed_as_the_protocol_says() {
        let request = FtpRequest {
            sequence: 0x1_0203,
            session: 9,
            opcode: FtpOpcode::OpenToRead,
            offset: 0x0405_0607,
            size: 2,
            data: b"ab".to_vec(),
        };
        let payload = request.payload();
        assert_eq!(payload[..12], [3, 2, 9, 4, 2, 0, 0, 0, 7, 6, 5, 4]);
        assert_eq!(&payload[12..15], b"ab\0");
    }

    #[test]
    fn answers_that_claim_too_much_are_none() {
        let mut payload = [0; 251];
        payload[3] = ACCEPTED;
        payload[4] = 239;
        assert!(FtpAnswer::read(&payload).is_some());
        payload[4] = 240;
        assert_eq!(FtpAnswer::read(&payload), None);
        payload[3..5].copy_from_slice(&[REFUSED, 0]);
        let refused = FtpAnswer::read(&payload).expect("an answer");
        assert_eq!(refused.result, Err(FtpNak::Other(0)));
        payload[3] = 5;
        assert_eq!(FtpAnswer::read(&payload), None);
    }

    #[test]
    fn numbers_are_found_again_after_16_bits() {
        let mut sequence = FtpSequence::default();
        for _ in 0..100 {
            sequence.pass_over_burst();
        }
        let request = sequence.next();
        assert!(request > 0x1_0000);
        assert_eq!(sequence.request_of((request + 1) as u16), request);
        sequence.pass_over_burst();
        assert_eq!(sequence.request_of((request + 1) as u16), request);
        assert_eq!(sequence.request_of((request + 4000) as u16), request + 3999);
    }
}
