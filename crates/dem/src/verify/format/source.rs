//! The bytes of a file, decompressed, in UTF-8 if they are text.

use std::io::{self, BufRead, BufReader, Cursor, Read};

use encoding_rs::{Encoding, UTF_16BE, UTF_16LE};
use encoding_rs_io::DecodeReaderBytesBuilder;
use flate2::read::MultiGzDecoder;
use ruzstd::decoding::StreamingDecoder;

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
            Self::sampled(Box::new(MultiGzDecoder::new(raw.all())))?
        } else if raw.sample.starts_with(b"\x28\xb5\x2f\xfd") {
            Self::sampled(Box::new(Frames::new(raw.all())))?
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

/// All frames of a zstd file, one after the other.
struct Frames<R: BufRead> {
    decoder: Option<StreamingDecoder<R, ruzstd::decoding::FrameDecoder>>,
    rest: Option<R>,
}

impl<R: BufRead> Frames<R> {
    fn new(input: R) -> Self {
        Self {
            decoder: None,
            rest: Some(input),
        }
    }
}

impl<R: BufRead> Read for Frames<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            if let Some(decoder) = &mut self.decoder {
                let read = decoder.read(buffer)?;
                if read > 0 || buffer.is_empty() {
                    return Ok(read);
                }
                self.rest = self.decoder.take().map(StreamingDecoder::into_inner);
            }
            let Some(mut rest) = self.rest.take() else {
                return Ok(0);
            };
            if rest.fill_buf()?.is_empty() {
                self.rest = Some(rest);
                return Ok(0);
            }
            let decoder = StreamingDecoder::new(rest).map_err(io::Error::other)?;
            self.decoder = Some(decoder);
        }
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
        let mut all = Vec::new();
        let source = Source::open(bytes, None).unwrap();
        source.all().read_to_end(&mut all).unwrap();
        all
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
        let read = Source::open(cut, None).and_then(|source| {
            let mut all = Vec::new();
            Ok(source.all().read_to_end(&mut all).map(drop)?)
        });
        assert!(matches!(read, Err(Refusal::Io(_))));
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
