//! The bytes of a file, decompressed, in UTF-8 if they are text.

use std::io::{self, BufRead, BufReader, Cursor, Read};

use encoding_rs::{Encoding, UTF_16BE, UTF_16LE};
use encoding_rs_io::DecodeReaderBytesBuilder;
use flate2::read::MultiGzDecoder;
use ruzstd::decoding::errors::{FrameDecoderError, ReadFrameHeaderError};
use ruzstd::decoding::{BlockDecodingStrategy, FrameDecoder};

use crate::verify::refusal::Refusal;

/// The number of bytes that are read before the kind and the dialect of a file are decided.
const SAMPLE: usize = 1 << 18;

/// The decompressed bytes of a file, with a sample of them.
pub(in crate::verify) struct Source<'r> {
    pub(in crate::verify) sample: Vec<u8>,
    /// True if the sample is the whole file.
    pub(in crate::verify) is_whole: bool,
    rest: Box<dyn Read + 'r>,
}

impl<'r> Source<'r> {
    /// Decompresses a file if it is compressed by gzip or zstd, and converts UTF-16 and the given encoding to UTF-8.
    pub(in crate::verify) fn open(
        input: impl Read + 'r,
        encoding: Option<&'static Encoding>,
    ) -> Result<Self, Refusal> {
        let raw = Self::sampled(Box::new(input))?;
        let source = if raw.sample.starts_with(b"\x1f\x8b") {
            let decoder = MultiGzDecoder::new(raw.all());
            Self::sampled(Box::new(Checked(decoder)))?
        } else if is_zstd(&raw.sample) {
            Self::sampled(Box::new(Checked(Frames::new(raw.all()))))?
        } else {
            raw
        };
        match encoding.or_else(|| utf_16(&source.sample)) {
            None => Ok(source),
            Some(encoding) => {
                let mut decoder = DecodeReaderBytesBuilder::new();
                Self::sampled(Box::new(
                    decoder.encoding(Some(encoding)).build(source.all()),
                ))
            }
        }
    }

    fn sampled(mut rest: Box<dyn Read + 'r>) -> Result<Self, Refusal> {
        let mut sample = Vec::new();
        (&mut rest).take(SAMPLE as u64).read_to_end(&mut sample)?;
        Ok(Self {
            is_whole: sample.len() < SAMPLE,
            sample,
            rest,
        })
    }

    /// Returns all bytes.
    pub(in crate::verify) fn all(self) -> impl BufRead + 'r {
        let rest = BufReader::with_capacity(1 << 16, self.rest);
        Cursor::new(self.sample).chain(rest)
    }

    /// Returns all bytes in memory.
    pub(in crate::verify) fn bytes(self) -> Result<Vec<u8>, Refusal> {
        let mut bytes = Vec::new();
        self.all().read_to_end(&mut bytes)?;
        Ok(bytes)
    }
}

/// Returns the encoding of a text in UTF-16, which begins with a byte order mark or has zeros beside ASCII.
fn utf_16(sample: &[u8]) -> Option<&'static Encoding> {
    let is_text = |byte: &u8| byte.is_ascii_graphic() || byte.is_ascii_whitespace();
    match sample {
        [0xff, 0xfe, ..] => Some(UTF_16LE),
        [0xfe, 0xff, ..] => Some(UTF_16BE),
        [a, 0, b, 0, ..] if is_text(a) && is_text(b) => Some(UTF_16LE),
        [0, a, 0, b, ..] if is_text(a) && is_text(b) => Some(UTF_16BE),
        _ => None,
    }
}

/// Returns whether a file begins with a frame of zstd, or with one that is to be passed over.
fn is_zstd(sample: &[u8]) -> bool {
    match sample {
        [first, rest @ ..] if first & 0xf0 == 0x50 => rest.starts_with(b"\x2a\x4d\x18"),
        _ => sample.starts_with(b"\x28\xb5\x2f\xfd"),
    }
}

/// A decoder whose errors say that the data are damaged.
struct Checked<R>(R);

impl<R: Read> Read for Checked<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer).map_err(|error| match error.kind() {
            io::ErrorKind::InvalidInput | io::ErrorKind::Other => damaged(),
            _ => error,
        })
    }
}

fn damaged() -> io::Error {
    let reason = "the compressed data are damaged or cut off";
    io::Error::new(io::ErrorKind::InvalidData, reason)
}

/// All frames of a zstd file, one after the other.
struct Frames<R> {
    decoder: FrameDecoder,
    is_in_frame: bool,
    input: R,
}

impl<R: BufRead> Frames<R> {
    fn new(input: R) -> Self {
        Self {
            decoder: FrameDecoder::new(),
            is_in_frame: false,
            input,
        }
    }

    /// Begins the next frame, unless it is to be passed over.
    fn begin(&mut self) -> io::Result<()> {
        use FrameDecoderError::ReadFrameHeaderError as Header;
        match self.decoder.init(&mut self.input) {
            Ok(()) => self.is_in_frame = true,
            Err(Header(ReadFrameHeaderError::SkipFrame { length, .. })) => {
                let mut left_out = (&mut self.input).take(length.into());
                if io::copy(&mut left_out, &mut io::sink())? < length.into() {
                    return Err(damaged());
                }
            }
            Err(_) => return Err(damaged()),
        }
        Ok(())
    }
}

impl<R: BufRead> Read for Frames<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while !buffer.is_empty() {
            if self.is_in_frame {
                let decoder = &mut self.decoder;
                while decoder.can_collect() < buffer.len() && !decoder.is_finished() {
                    let wanted = BlockDecodingStrategy::UptoBytes(buffer.len());
                    let decoded = decoder.decode_blocks(&mut self.input, wanted);
                    decoded.map_err(|_| damaged())?;
                }
                let read = decoder.read(buffer)?;
                if read > 0 {
                    return Ok(read);
                }
                let sum = decoder.get_checksum_from_data();
                if sum.is_some() && sum != decoder.get_calculated_checksum() {
                    return Err(damaged());
                }
                self.is_in_frame = false;
            }
            if self.input.fill_buf()?.is_empty() {
                return Ok(0);
            }
            self.begin()?;
        }
        Ok(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::read::GzEncoder;
    use ruzstd::encoding::{CompressionLevel, compress_to_vec};

    /// Longer than the sample.
    fn text() -> String {
        let rows = (0..40_000).map(|n| format!("1,{n},0.5 µN\n"));
        "id1,id2,force\n".to_owned() + &rows.collect::<String>()
    }

    fn all(bytes: &[u8]) -> Vec<u8> {
        Source::open(bytes, None).unwrap().bytes().unwrap()
    }

    #[test]
    fn compressed_files_are_read_as_their_content() {
        let text = text();
        let bytes = text.as_bytes();
        let (begin, end) = bytes.split_at(100_000);
        let gzip = |bytes: &[u8]| {
            let mut packed = Vec::new();
            let mut encoder = GzEncoder::new(bytes, Compression::fast());
            encoder.read_to_end(&mut packed).unwrap();
            packed
        };
        let zstd = |bytes: &[u8]| compress_to_vec(bytes, CompressionLevel::Fastest);
        for packed in [
            gzip(bytes),
            zstd(bytes),
            // Both formats may be written one after the other.
            [gzip(begin), gzip(end)].concat(),
            [zstd(begin), zstd(end)].concat(),
        ] {
            assert!(packed.len() < bytes.len() / 2);
            assert!(all(&packed) == bytes);
        }
        let cut = gzip(bytes);
        let cut = cut.get(..cut.len() / 2).unwrap();
        let read = Source::open(cut, None).and_then(Source::bytes);
        assert!(matches!(read, Err(Refusal::Io(_))));
    }

    #[test]
    fn damaged_files_are_rejected() {
        let whole = compress_to_vec(&b"id1,id2,force\n1,2,0.5\n"[..], CompressionLevel::Fastest);
        let left_out = b"\x5a\x2a\x4d\x18\x03\0\0\0abc";
        let read = all(&[&left_out[..], &whole, left_out, &whole].concat());
        assert!(read.starts_with(b"id1") && read.len() == 2 * 22);
        let damaged = |bytes: &[u8]| match Source::open(bytes, None) {
            Err(Refusal::Io(error)) => error.kind() == io::ErrorKind::InvalidData,
            _ => false,
        };
        for place in [whole.len() - 1, whole.len() - 6] {
            let mut changed = whole.clone();
            changed[place] ^= 1;
            assert!(damaged(&changed), "{place}");
        }
        for length in 5..whole.len() {
            assert!(damaged(&whole[..length]), "{length}");
        }
        assert!(damaged(&left_out[..left_out.len() - 1]));
    }

    #[test]
    fn utf_16_is_read_with_and_without_a_byte_order_mark() {
        let text = text();
        for (mark, to_bytes) in [
            (true, u16::to_le_bytes as fn(u16) -> [u8; 2]),
            (true, u16::to_be_bytes),
            (false, u16::to_le_bytes),
            (false, u16::to_be_bytes),
        ] {
            let mark = mark.then_some(0xfeff);
            let units = mark.into_iter().chain(text.encode_utf16());
            let bytes: Vec<u8> = units.flat_map(to_bytes).collect();
            assert!(all(&bytes) == text.as_bytes(), "{mark:?}");
        }
    }
}
