//! Output: results to standard output, everything else to standard error.
//!
//! A reader that closes the pipe (`pelea … | head`) is not an error: further output is dropped, and
//! the exit code is still that of the command. Colours are written only to a terminal that supports
//! them.

use crate::outlet::Outlet;
use serde::Serialize;
use std::io::{self, IsTerminal, Write};

/// How results are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Text for people.
    Text,
    /// One JSON object per line, all on standard output.
    Json,
}

/// Standard output and standard error, or a test's replacements for them.
pub struct Console<'a> {
    out: Box<dyn Write + 'a>,
    err: Box<dyn Write + 'a>,
    form: Form,
    colour: bool,
    result_colour: bool,
    result_width: Option<usize>,
    /// Whether it writes to the standard streams of the process.
    of_process: bool,
}

/// The output of another thread, kept until its turn.
#[derive(Debug, Default)]
pub(crate) struct Said {
    out: Vec<u8>,
    err: Vec<u8>,
}

/// The settings of a console.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Manner {
    form: Form,
    colour: bool,
    result_colour: bool,
}

impl Manner {
    /// A console that keeps its output until [`Console::replay`].
    pub(crate) fn console(self, said: &mut Said) -> Console<'_> {
        let Said { out, err } = said;
        let mut console = Console::new(out, err);
        console.form = self.form;
        console.colour = self.colour;
        console.result_colour = self.result_colour;
        console
    }
}

impl<'a> Console<'a> {
    /// Writes to `out` and `err`, without colours.
    pub fn new(out: &'a mut dyn Write, err: &'a mut dyn Write) -> Self {
        Self {
            out: Box::new(out),
            err: Box::new(err),
            form: Form::Text,
            colour: false,
            result_colour: false,
            result_width: None,
            of_process: false,
        }
    }

    /// The standard output and standard error of the process.
    pub fn of_process() -> Console<'static> {
        let wanted = std::env::var_os("NO_COLOR").is_none();
        Console {
            out: Box::new(io::BufWriter::new(io::stdout())),
            err: Box::new(io::stderr()),
            form: Form::Text,
            colour: wanted && io::stderr().is_terminal(),
            result_colour: wanted && io::stdout().is_terminal(),
            result_width: terminal_size::terminal_size_of(io::stdout()).map(|(width, _)| width.0.into()),
            of_process: true,
        }
    }

    /// From now on, no write waits for the reader: for commands during which a robot moves.
    pub(crate) fn never_wait(&mut self) {
        if self.of_process {
            self.flush();
            let note: fn(usize) -> String = match self.form {
                Form::Text => |lost| format!("({lost} lines were not read in time, and are left out here)"),
                Form::Json => |lost| format!(r#"{{"kind":"lost","lines":{lost}}}"#),
            };
            self.out = Box::new(Outlet::new(io::stdout(), note));
            self.err = Box::new(Outlet::new(io::stderr(), note));
        }
    }

    /// The settings of this console, for consoles on other threads.
    pub(crate) fn manner(&self) -> Manner {
        Manner { form: self.form, colour: self.colour, result_colour: self.result_colour }
    }

    /// Writes the kept output.
    pub(crate) fn replay(&mut self, said: &Said) {
        dropped(self.err.write_all(&said.err));
        dropped(self.out.write_all(&said.out));
    }

    /// The form of results.
    pub fn form(&self) -> Form {
        self.form
    }

    /// Whether standard error supports colours.
    pub fn colour(&self) -> bool {
        self.colour
    }

    /// Whether standard output supports colours.
    pub fn result_colour(&self) -> bool {
        self.result_colour
    }

    /// The number of columns of the terminal on standard output; `None` if it is not a terminal.
    pub fn result_width(&self) -> Option<usize> {
        self.result_width
    }

    /// Flushes standard output.
    pub fn flush(&mut self) {
        dropped(self.out.flush());
    }

    pub(crate) fn set_form(&mut self, form: Form) {
        self.form = form;
    }

    /// Writes a result as a line of text; writes nothing in JSON form.
    pub fn result(&mut self, line: &str) {
        if self.form == Form::Text {
            dropped(writeln!(self.out, "{line}"));
        }
    }

    /// Writes a result as an object; writes nothing in text form.
    pub fn record(&mut self, record: &impl Serialize) {
        if self.form == Form::Json
            && let Ok(line) = serde_json::to_string(record)
        {
            dropped(writeln!(self.out, "{line}"));
        }
    }

    /// Writes a line for people, besides the result.
    pub fn note(&mut self, line: &str) {
        if self.form == Form::Text {
            dropped(writeln!(self.err, "{line}"));
        }
    }

    /// Writes text for people that has its own line ends.
    pub fn block(&mut self, text: &str) {
        if self.form == Form::Text {
            dropped(self.err.write_all(text.as_bytes()));
        }
    }

    /// Writes text on standard output in either form, such as `--help`.
    pub(crate) fn print(&mut self, text: &str) {
        dropped(self.out.write_all(text.as_bytes()));
    }

    /// Writes text on standard error in either form, such as wrong arguments.
    pub(crate) fn complain(&mut self, text: &str) {
        dropped(self.err.write_all(text.as_bytes()));
    }
}

impl Drop for Console<'_> {
    fn drop(&mut self) {
        dropped(self.out.flush());
    }
}

/// Ignores an error: the reader may have closed the pipe.
fn dropped(_: io::Result<()>) {}
