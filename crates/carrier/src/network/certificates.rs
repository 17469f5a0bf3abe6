//! Makes keys and certificates.

use rcgen::{
    BasicConstraints, CertificateParams, DistinguishedName, DnType, ExtendedKeyUsagePurpose, IsCa,
    Issuer, KeyPair, KeyUsagePurpose, PKCS_ED25519, PublicKeyData as _, date_time_ymd,
};

use crate::fault::NetworkFault;

/// The first year in which certificates are valid. Machines of a lab without network may have wrong clocks, so they
/// are valid long before and after any class; a class ends when its folder is deleted.
const FROM_YEAR: i32 = 2000;
/// The year in which they are not valid any more.
const TO_YEAR: i32 = 2100;

impl From<rcgen::Error> for NetworkFault {
    fn from(fault: rcgen::Error) -> Self {
        Self::Crypto(fault.to_string())
    }
}

/// A secret key, its public key, and a certificate of it.
pub(super) struct Identity {
    /// PKCS #8.
    pub key: Vec<u8>,
    pub public_key: Vec<u8>,
    /// DER.
    pub certificate: Vec<u8>,
}

fn params(common_name: &str, names: Vec<String>) -> Result<CertificateParams, NetworkFault> {
    let mut params = CertificateParams::new(names)?;
    params.distinguished_name = DistinguishedName::new();
    params
        .distinguished_name
        .push(DnType::CommonName, common_name);
    params.not_before = date_time_ymd(FROM_YEAR, 1, 1);
    params.not_after = date_time_ymd(TO_YEAR, 1, 1);
    Ok(params)
}

/// The certificate of a desk: signed by itself, for the addresses at which seats reach it. All certificates that are
/// made with one key replace each other, so that the addresses may change after the join lines are given out.
pub(super) fn desk_certificate(
    class: &str,
    key: &[u8],
    hosts: Vec<String>,
) -> Result<Vec<u8>, NetworkFault> {
    let key = KeyPair::try_from(key)?;
    let mut params = params(&format!("{class} desk"), hosts)?;
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth];
    Ok(params.self_signed(&key)?.der().to_vec())
}

/// The key of a desk, with a certificate for no address.
pub(super) fn desk(class: &str) -> Result<Identity, NetworkFault> {
    let key = KeyPair::generate_for(&PKCS_ED25519)?;
    let pkcs8 = key.serialize_der();
    Ok(Identity {
        certificate: desk_certificate(class, &pkcs8, Vec::new())?,
        public_key: key.der_bytes().to_vec(),
        key: pkcs8,
    })
}

/// The authority that makes the certificates of seats. It exists only while a class is made: its key is never stored,
/// so nobody can add a seat afterwards.
pub(super) struct SeatAuthority {
    issuer: Issuer<'static, KeyPair>,
    /// DER.
    pub certificate: Vec<u8>,
}

impl SeatAuthority {
    pub fn new(class: &str) -> Result<Self, NetworkFault> {
        let key = KeyPair::generate_for(&PKCS_ED25519)?;
        let mut params = params(&format!("{class} seats"), Vec::new())?;
        params.is_ca = IsCa::Ca(BasicConstraints::Constrained(0));
        params.key_usages = vec![KeyUsagePurpose::KeyCertSign];
        let certificate = params.self_signed(&key)?.der().to_vec();
        Ok(Self {
            issuer: Issuer::new(params, key),
            certificate,
        })
    }

    /// The key and the certificate of a seat, which cannot be used for a desk.
    pub fn seat(&self, name: &str) -> Result<Identity, NetworkFault> {
        let key = KeyPair::generate_for(&PKCS_ED25519)?;
        let mut params = params(name, Vec::new())?;
        params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth];
        Ok(Identity {
            certificate: params.signed_by(&key, &self.issuer)?.der().to_vec(),
            public_key: key.der_bytes().to_vec(),
            key: key.serialize_der(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Clocks of a lab may be wrong by hours or years: only these two times are compared with them.
    #[test]
    fn certificates_are_valid_whatever_a_clock_of_this_century_says() {
        let authority = SeatAuthority::new("9-A").expect("made");
        let seat = authority.seat("seat-01").expect("made");
        let desk = desk("9-A").expect("made");
        for certificate in [&authority.certificate, &seat.certificate, &desk.certificate] {
            // In DER: until 2049 with two digits of the year, later with four.
            for time in ["\x17\x0d000101000000Z", "\x18\x0f21000101000000Z"] {
                let mut parts = certificate.windows(time.len());
                assert!(parts.any(|part| part == time.as_bytes()), "{time:?}");
            }
        }
    }
}
