//! Reading and writing of certificates as JSON files.

use core::fmt;
use std::io::{self, BufReader, Read, Write};

use cannonpile::Pile;
use cannonpile::data::listed::Key;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error as _, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::Certificate;
use super::text::Text;

/// The maximum size of a certificate file: 512 MiB.
pub const MAX_BYTES: u64 = 512 << 20;

/// Reads a file with one certificate or an array of certificates.
///
/// # Errors
/// Returns the errors of [`read_certificate`].
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_horizontal::certificate::{read_certificates, write_certificates};
/// use cannonpile_horizontal::equilibrium;
///
/// let certificates = [equilibrium(&Pile::triangular(3)?)?, equilibrium(&Pile::discs(3)?)?];
/// let mut text = Vec::new();
/// write_certificates(&certificates, &mut text)?;
/// assert_eq!(read_certificates(&*text)?, certificates);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_certificates(mut input: impl Read) -> io::Result<Vec<Certificate>> {
    let OneOrMore(certificates) = read(&mut input)?;
    Ok(certificates)
}

/// Reads a certificate from JSON, as a stream. The memory needed is a few times the size of the file, which is
/// limited to [`MAX_BYTES`]. The guide has the grammar, `docs/certificates.md`; other notations of numbers, stackings and
/// records are errors.
///
/// # Errors
/// * The errors of `input`.
/// * [`InvalidData`](io::ErrorKind::InvalidData) or [`UnexpectedEof`](io::ErrorKind::UnexpectedEof), with the line,
///   if the input is not a certificate.
/// * [`FileTooLarge`](io::ErrorKind::FileTooLarge) if the input is too long.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::certificate::read_certificate;
///
/// let text = r#"{
///   "pile": {"dimension":3,"sin_phi":"1/2","stacking":"+++","anchor":{"top":"hexagon:1"},"weightless":false,"weights":[],"loads":[]},
///   "claim": {"least":{"site":{"i":1,"j":1,"k":3},"normal":"1","attained":false}},
///   "horizontal": [],
///   "field": []
/// }"#;
/// let certificate = read_certificate(text.as_bytes())?;
/// assert_eq!(certificate.check(), Ok(()));
///
/// let error = read_certificate(&text.as_bytes()[..100]).unwrap_err();
/// assert!(error.to_string().contains("line 2"));
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn read_certificate(mut input: impl Read) -> io::Result<Certificate> {
    read(&mut input)
}

// With `dyn` the parser is compiled once, and not for each type of reader.
fn read<T: for<'de> Deserialize<'de>>(input: &mut dyn Read) -> io::Result<T> {
    let input = Limited {
        input,
        left: MAX_BYTES,
    };
    Ok(serde_json::from_reader(BufReader::new(Text::new(input)))?)
}

/// Reads the pile of a certificate, which has no horizontal forces.
pub(super) fn pile<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Pile, D::Error> {
    let pile = Pile::deserialize(deserializer)?;
    if pile.horizontal_forces().len() > 0 {
        return Err(D::Error::custom(
            "the pile of a certificate has horizontal forces; move them to the certificate",
        ));
    }
    Ok(pile)
}

/// One certificate or a list of certificates.
struct OneOrMore(Vec<Certificate>);

impl<'de> Deserialize<'de> for OneOrMore {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OneOrMore(Vec::new()))
    }
}

impl<'de> Visitor<'de> for OneOrMore {
    type Value = Self;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a certificate, or an array of certificates")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self, A::Error> {
        let certificate = Certificate::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Self(vec![certificate]))
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut list: A) -> Result<Self, A::Error> {
        while let Some(certificate) = list.next_element()? {
            self.0.push(certificate);
        }
        if self.0.is_empty() {
            return Err(A::Error::custom(
                "the array of certificates is empty; it needs at least one",
            ));
        }
        Ok(self)
    }
}

/// Writes a certificate as JSON, with one line for each horizontal contact and for each sphere of the field.
///
/// # Errors
/// Returns the errors of the output.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
/// use cannonpile_horizontal::certificate::{Certificate, Claim};
/// use cannonpile_horizontal::certificate::{read_certificate, write_certificate};
/// use num_rational::BigRational;
///
/// let certificate = Certificate {
///     pile: Pile::triangular(3)?,
///     claim: Claim::Stands,
///     horizontal: [].into(),
///     field: [(Site::APEX, [1, 0, 0].map(|n| BigRational::from_integer(n.into())))].into(),
/// };
/// let mut text = Vec::new();
/// write_certificate(&certificate, &mut text)?;
/// assert_eq!(read_certificate(&*text)?, certificate);
///
/// let text = String::from_utf8(text)?;
/// let lines: Vec<&str> = text.lines().collect();
/// assert_eq!(lines[2], r#"  "claim": "stands","#);
/// assert_eq!(lines[5], r#"    {"site":{"i":0,"j":0,"k":0},"alpha":"1","beta":"0","gamma":"0"}"#);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_certificate(certificate: &Certificate, out: &mut dyn Write) -> io::Result<()> {
    let Certificate {
        pile,
        claim,
        horizontal,
        field,
    } = certificate;
    out.write_all(b"{\n  \"pile\": ")?;
    serde_json::to_writer(&mut *out, pile)?;
    out.write_all(b",\n  \"claim\": ")?;
    serde_json::to_writer(&mut *out, claim)?;
    out.write_all(b",\n  \"horizontal\": ")?;
    lines(horizontal.iter().map(|(key, held)| key.entry(held)), out)?;
    out.write_all(b",\n  \"field\": ")?;
    lines(field.iter().map(|(key, held)| key.entry(held)), out)?;
    out.write_all(b"\n}\n")
}

/// Writes certificates as a JSON array.
///
/// # Errors
/// Returns the errors of the output.
///
/// # Examples
/// See [`read_certificates`].
pub fn write_certificates(certificates: &[Certificate], out: &mut dyn Write) -> io::Result<()> {
    let mut gap = "[\n";
    for certificate in certificates {
        out.write_all(gap.as_bytes())?;
        write_certificate(certificate, out)?;
        gap = ",\n";
    }
    out.write_all(if certificates.is_empty() {
        b"[]\n"
    } else {
        b"]\n"
    })
}

/// Writes a JSON list with one line for each entry.
fn lines(entries: impl Iterator<Item = impl Serialize>, out: &mut dyn Write) -> io::Result<()> {
    let mut gap = "[\n    ";
    for entry in entries {
        out.write_all(gap.as_bytes())?;
        serde_json::to_writer(&mut *out, &entry)?;
        gap = ",\n    ";
    }
    let end = if gap.starts_with('[') { "[]" } else { "\n  ]" };
    out.write_all(end.as_bytes())
}

/// A reader that returns an error after `left` bytes.
struct Limited<R> {
    input: R,
    left: u64,
}

impl<R: Read> Read for Limited<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.input.read(bytes)?;
        let left = self.left.checked_sub(read as u64);
        self.left = left.ok_or_else(|| {
            let message =
                format!("the certificate has more than {MAX_BYTES} bytes; certify a smaller pile");
            io::Error::new(io::ErrorKind::FileTooLarge, message)
        })?;
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_beyond_limit_is_refused() {
        for (length, fits) in [(99, true), (100, true), (101, false)] {
            let (input, left) = (io::repeat(b' ').take(length), 100);
            let read = io::copy(&mut Limited { input, left }, &mut io::sink());
            let kind = read.map_err(|error| error.kind());
            let expected = fits.then_some(length).ok_or(io::ErrorKind::FileTooLarge);
            assert_eq!(kind, expected);
        }
    }
}
