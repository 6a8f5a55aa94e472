//! The `periplus` command.

mod bag;
mod check;
mod convert;
mod options;
mod sim;
mod terminal;
mod verbs;

use std::process::ExitCode;

use clap::Parser as _;

use options::{Command, Options};

fn main() -> ExitCode {
    // A usage error ends here with exit code 2, and a message of clap's.
    let options = Options::parse();
    options.colour.apply();
    let outcome = match options.command {
        Command::Bag(command) => bag::run(&command),
        Command::Check(options) => check::run(&options),
        Command::Convert(options) => convert::run(&options),
        Command::Sim(options) => sim::run(&options),
        Command::Action(options) => options.run(),
        Command::Interface(options) => options.run(),
        Command::Lifecycle(options) => options.run(),
        Command::Node(options) => options.run(),
        Command::Service(options) => options.run(),
        Command::Topic(options) => options.run(),
    };
    match outcome {
        Ok(code) => code,
        // Whoever read our output has seen enough.
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            terminal::complain(&format!("cannot write the output: {error}"));
            ExitCode::FAILURE
        }
    }
}
