//! The table of measurements, as text and as CSV.

use std::path::Path;

use crate::run::{Measured, Run};

/// Prints the runs of one pile.
pub(crate) fn print(runs: &[Run]) {
    let Some(Run { pile, contacts, .. }) = runs.first() else {
        return;
    };
    println!("\n{pile}: {contacts} contacts");
    println!(
        "method              scalar         setting           time (ms)  ns/contact  relative error"
    );
    for run in runs {
        let (method, scalar, setting) = (run.method.name(), run.scalar, &run.setting);
        print!("{method:19} {scalar:14} {setting:16} ");
        match &run.outcome {
            Ok(Measured { seconds, error }) => {
                let (time, each) = (seconds * 1e3, seconds * 1e9 / contacts);
                let error = if *error > 0.0 {
                    format!("{error:.1e}")
                } else {
                    "0".into()
                };
                println!("{time:10.3} {each:11.1} {error:>15}  {}", run.remark);
            }
            Err(why) => println!("{why}"),
        }
    }
}

/// Writes all runs. The remark of a row without numbers gives the reason.
pub(crate) fn write(file: &Path, runs: &[Run]) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_path(file)?;
    table.write_record([
        "pile",
        "contacts",
        "method",
        "scalar",
        "setting",
        "seconds",
        "relative_error",
        "remark",
    ])?;
    for run in runs {
        let (seconds, error, remark) = match &run.outcome {
            Ok(Measured { seconds, error }) => {
                (format!("{seconds:e}"), format!("{error:e}"), &run.remark)
            }
            Err(why) => (String::new(), String::new(), why),
        };
        let contacts = run.contacts.to_string();
        let named = [
            &run.pile,
            &contacts,
            run.method.name(),
            run.scalar,
            &run.setting,
        ];
        table.write_record(named.into_iter().chain([seconds.as_str(), &error, remark]))?;
    }
    table.flush()?;
    Ok(())
}
