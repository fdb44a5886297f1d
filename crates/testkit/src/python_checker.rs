//! The second checker of certificates, in Python. It is one process that reads a certificate per line and prints a verdict
//! per line.
//!
//! It needs `python3`. Without it, a call panics unless `CANNONPILE_WITHOUT_PYTHON` is set.

use std::env;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::{Mutex, OnceLock, PoisonError};

/// The Python program: reads certificates from lines, and prints the exit status and the message of the checker.
const LINES: &str = "
import io, sys
sys.path.insert(0, sys.argv[1])
import check_certificate
getattr(sys, 'set_int_max_str_digits', lambda _: None)(0)
for line in sys.stdin:
    status, said = check_certificate.verdict(io.StringIO(line))
    print(status, ' '.join(said.split()), flush=True)
";

struct Checker {
    process: Child,
    questions: ChildStdin,
    answers: BufReader<ChildStdout>,
}

static CHECKER: OnceLock<Option<Mutex<Checker>>> = OnceLock::new();

/// The exit status of the checker for this file: 0 accepted, 1 rejected, 2 not a certificate. `None` if Python is missing
/// and `CANNONPILE_WITHOUT_PYTHON` is set.
pub fn status(certificate: &[u8]) -> Option<u8> {
    verdict(certificate).map(|(status, _)| status)
}

/// The [`status`] and the message, which is one line.
pub fn verdict(certificate: &[u8]) -> Option<(u8, String)> {
    let checker = CHECKER.get_or_init(|| Checker::start().map(Mutex::new));
    let mut checker = checker
        .as_ref()?
        .lock()
        .unwrap_or_else(PoisonError::into_inner);
    let answer = checker.ask(certificate);
    let verdict = answer.trim_end().split_once(' ');
    let verdict = verdict.and_then(|(status, said)| Some((status.parse().ok()?, said.into())));
    Some(verdict.unwrap_or_else(|| panic!("no verdict from the Python checker: {answer:?}")))
}

impl Checker {
    fn start() -> Option<Self> {
        let process = Command::new("python3")
            .args(["-B", "-c", LINES])
            .arg(folder())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn();
        let mut process = match process {
            Ok(process) => process,
            Err(error) => {
                assert!(
                    env::var_os("CANNONPILE_WITHOUT_PYTHON").is_some(),
                    "no python3 ({error}): the second checker is NOT compared; install Python 3.9 or later, or set \\
                     CANNONPILE_WITHOUT_PYTHON=1 to go without"
                );
                return None;
            }
        };
        Some(Self {
            questions: process.stdin.take().expect("a pipe"),
            answers: BufReader::new(process.stdout.take().expect("a pipe")),
            process,
        })
    }

    fn ask(&mut self, certificate: &[u8]) -> String {
        let mut line = certificate.to_vec();
        // Line breaks occur only between JSON tokens, so a space can replace them.
        for byte in &mut line {
            if *byte == b'\n' {
                *byte = b' ';
            }
        }
        line.push(b'\n');
        self.questions.write_all(&line).expect("python3 reads");
        let mut answer = String::new();
        self.answers
            .read_line(&mut answer)
            .expect("python3 answers");
        answer
    }
}

impl Drop for Checker {
    fn drop(&mut self) {
        let _ = self.process.kill();
    }
}

/// The folder of the script, in the crate that writes certificates.
fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../horizontal");
    let script = folder.join("check_certificate.py");
    assert!(script.exists(), "no {}", script.display());
    folder
}
