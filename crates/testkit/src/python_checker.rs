//! The second checker of certificates, in Python. It is one process that reads a certificate per line and prints a verdict
//! per line.
//!
//! It needs `python3`. Without it there are no verdicts, and [`left_out`] reports that.

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::thread;

use crate::processes::{LONGEST_WAIT, Process, left_out};

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
    /// Dropping this value ends the process.
    _process: Process,
    questions: Sender<Vec<u8>>,
    answers: Receiver<String>,
}

static CHECKER: OnceLock<Option<Mutex<Checker>>> = OnceLock::new();

/// The exit status of the checker for this file: 0 accepted, 1 rejected, 2 not a certificate. `None` without Python.
pub fn status(certificate: &[u8]) -> Option<u8> {
    verdict(certificate).map(|(status, _)| status)
}

/// The [`status`] and the message, which is one line.
pub fn verdict(certificate: &[u8]) -> Option<(u8, String)> {
    let checker = CHECKER.get_or_init(|| python().map(|python| Mutex::new(Checker::start(python))));
    let checker = checker
        .as_ref()?
        .lock()
        .unwrap_or_else(PoisonError::into_inner);
    let answer = checker.ask(certificate);
    let verdict = answer.trim_end().split_once(' ');
    let verdict = verdict.and_then(|(status, said)| Some((status.parse().ok()?, said.into())));
    Some(verdict.unwrap_or_else(|| panic!("no verdict from the Python checker: {answer:?}")))
}

/// The command `python3`, independent of the environment. `None` if there is none of version 3.9 or later; the first call
/// reports that.
pub fn python() -> Option<Command> {
    static IS_INSTALLED: OnceLock<bool> = OnceLock::new();
    let python = || {
        let mut python = Command::new("python3");
        // Isolated from variables and packages of the user, in UTF-8 under every locale, and without `__pycache__`.
        python.args(["-I", "-X", "utf8", "-B"]).stdin(Stdio::null());
        python
    };
    let is_installed = *IS_INSTALLED.get_or_init(|| {
        let mut version = python();
        version.args(["-c", "import sys; sys.exit(sys.version_info < (3, 9))"]);
        let process = Process::start(version.stdout(Stdio::null()).stderr(Stdio::null()));
        let is_installed = process.is_ok_and(|process| process.output().status.success());
        if !is_installed {
            left_out("the checker of certificates in Python: there is no python3 of version 3.9 or later");
        }
        is_installed
    });
    is_installed.then(python)
}

/// The script, in the crate that writes certificates.
pub fn script() -> PathBuf {
    folder().join("check_certificate.py")
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../horizontal")
}

impl Checker {
    fn start(mut python: Command) -> Self {
        let command = python.args(["-c", LINES]).arg(folder());
        let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut process = Process::start(piped).expect("python3 starts");
        let (mut stdin, stdout) = (process.stdin(), BufReader::new(process.stdout()));
        // Threads write and read, so that no question waits for ever.
        let (questions, asked) = mpsc::channel::<Vec<u8>>();
        thread::spawn(move || asked.iter().try_for_each(|line| stdin.write_all(&line)));
        let (answer, answers) = mpsc::channel();
        thread::spawn(move || {
            let mut lines = stdout.lines().map_while(Result::ok);
            lines.try_for_each(|line| answer.send(line))
        });
        Self {
            _process: process,
            questions,
            answers,
        }
    }

    fn ask(&self, certificate: &[u8]) -> String {
        let mut line = certificate.to_vec();
        // Line breaks occur only between JSON tokens, so a space can replace them.
        for byte in &mut line {
            if *byte == b'\n' {
                *byte = b' ';
            }
        }
        line.push(b'\n');
        self.questions.send(line).expect("python3 reads");
        let answer = self.answers.recv_timeout(LONGEST_WAIT);
        answer.expect("python3 answers")
    }
}
