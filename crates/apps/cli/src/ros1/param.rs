//! `periplus ros1 param`: the parameter server.

use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Subcommand;
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_ros1::{MasterClient, RpcError, XmlRpcValue};

use super::{client, failed, full, yaml};
use crate::error::CliError;

/// Read and write the parameters of a ROS 1 master
#[derive(Debug, Subcommand)]
pub(crate) enum ParamCommand {
    /// List all parameters, or those of a namespace
    List {
        /// Namespace
        #[arg(default_value = "/")]
        namespace: String,
    },
    /// Print a parameter, or a namespace as YAML
    Get {
        /// Name
        name: String,
    },
    /// Set a parameter, or a namespace with a dictionary
    Set {
        /// Name
        name: String,
        /// XmlRpcValue as YAML
        #[arg(required_unless_present = "textfile", allow_negative_numbers = true)]
        value: Option<String>,
        /// File whose text is the value
        #[arg(long, short, value_name = "FILE")]
        textfile: Option<PathBuf>,
    },
    /// Delete a parameter or a namespace
    Delete {
        /// Name
        name: String,
    },
    /// Write parameters as YAML
    Dump {
        /// Output file [default: standard output]
        file: Option<PathBuf>,
        /// Namespace
        #[arg(default_value = "/")]
        namespace: String,
    },
    /// Set the parameters of a YAML file
    Load {
        /// File, `-` for standard input
        file: PathBuf,
        /// Namespace
        #[arg(default_value = "/")]
        namespace: String,
    },
}

pub(super) fn run(command: &ParamCommand) -> Result<ExitCode, CliError> {
    let client = client()?;
    let ask = |method: &str, params: Vec<XmlRpcValue>| {
        client.ask(method, params).map_err(|error| failed(&client, error))
    };
    let mut out = io::stdout().lock();
    match command {
        ParamCommand::List { namespace } => {
            let names = ask("getParamNames", Vec::new())?;
            let mut names: Vec<&str> =
                names.list().unwrap_or_default().iter().filter_map(XmlRpcValue::text).collect();
            names.sort_unstable();
            let front = format!("{}/", full(namespace).trim_end_matches('/'));
            for name in names.iter().filter(|name| name.starts_with(&front)) {
                writeln!(out, "{name}")?;
            }
        }
        ParamCommand::Get { name } => {
            let value = get(&client, name)?;
            out.write_all(yaml::write(&value).as_bytes())?;
        }
        ParamCommand::Set { name, value, textfile } => {
            let value = match (value, textfile) {
                (_, Some(file)) => XmlRpcValue::Text(read(file)?),
                (Some(value), None) => yaml::read("VALUE", value)?,
                (None, None) => return Err(CliError::usage("no value is given")),
            };
            ask("setParam", vec![full(name).into(), value])?;
        }
        ParamCommand::Delete { name } => {
            ask("deleteParam", vec![full(name).into()])?;
        }
        ParamCommand::Dump { file, namespace } => {
            let text = yaml::write(&get(&client, namespace)?);
            match file {
                Some(file) => std::fs::write(file, text).map_err(|error| {
                    CliError::failed(format!("cannot write {}: {error}", file.display()))
                })?,
                None => out.write_all(text.as_bytes())?,
            }
        }
        ParamCommand::Load { file, namespace } => {
            let text = if file.as_os_str() == "-" {
                let mut text = String::new();
                io::stdin().lock().read_to_string(&mut text)?;
                text
            } else {
                read(file)?
            };
            let XmlRpcValue::Struct(members) = yaml::read(&file.display().to_string(), &text)?
            else {
                return Err(CliError::failed(format!(
                    "{} has no names of parameters at its top level",
                    file.display()
                )));
            };
            let front = full(namespace);
            let front = front.trim_end_matches('/');
            let all = members.into_iter();
            let all = all.map(|(name, value)| (format!("{front}/{name}"), value)).collect();
            client.set_parameters(all).map_err(|error| failed(&client, error))?;
        }
    }
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}

fn get(client: &MasterClient, name: &str) -> Result<XmlRpcValue, CliError> {
    client.ask("getParam", vec![full(name).into()]).map_err(|error| match error {
        RpcError::Refused(_) => CliError::failed(format!(
            "the parameter {} is not set: `periplus ros1 param list` lists all",
            full(name)
        )),
        error => failed(client, error),
    })
}

fn read(file: &Path) -> Result<String, CliError> {
    let failed = |why: &dyn std::fmt::Display| {
        CliError::failed(format!("cannot read {}: {why}", file.display()))
    };
    let bytes = Machine.read(file).map_err(|error| failed(&error))?;
    String::from_utf8(bytes).map_err(|_| failed(&"it is not UTF-8"))
}
