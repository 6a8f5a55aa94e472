//! `periplus mcp`: the commands as tools of the Model Context Protocol.

mod call;
mod files;
mod tools;

use std::io::{self, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use rmcp::model::{
    CallToolRequestParams, CallToolResponse, CallToolResult, Implementation, ListToolsResult,
    PaginatedRequestParams, ServerCapabilities, ServerConfig, Tool,
};
use rmcp::service::{RequestContext, RoleServer};
use rmcp::{ErrorData, ServerHandler, ServiceExt as _};

use crate::error::CliError;
use crate::help;
use crate::own_command::own_command;
use tools::VerbTool;

/// Instructions for clients, sent at the start.
const INSTRUCTIONS: &str = "Periplus simulates mobile robots, builds maps, localizes and navigates. Every tool is a \
    command of `periplus` with the same options. Files are read from and written to the working folder of the server. \
    A usual task: `check` a robot (URDF, xacro, SDF) or a world and correct what it reports; `look` for a picture of it; \
    `sim` with `duration` and `record` (drive by a script with `cmd`), or `navigate` to goals; `slam` a recording into \
    a map; `score` and `report` a run against the truth. Commands without an end run until `timeout_s`.";

/// Serve the commands as tools of the Model Context Protocol, on standard input and output
///
/// For agents: the client starts this command and speaks JSON-RPC with it. Each tool is a command of
/// `periplus`; its result has the output, the exit code, and the pictures that were written.
#[derive(Debug, Args)]
pub(crate) struct McpOptions {
    /// Folder for the files of all tools [default: the current folder]
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Offer only these tools, such as `check,look,sim`
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    tools: Vec<String>,
    /// Print the tools with the schemas of their arguments as JSON, and exit
    #[arg(long)]
    list: bool,
}

pub(crate) fn run(options: &McpOptions) -> Result<ExitCode, CliError> {
    let tools = options.selected()?;
    if options.list {
        let tools: Vec<Tool> = tools.iter().map(VerbTool::to_tool).collect();
        let text = serde_json::to_string_pretty(&tools).map_err(CliError::failed)?;
        writeln!(io::stdout().lock(), "{text}")?;
        return Ok(ExitCode::SUCCESS);
    }
    if own_command().is_empty() {
        return Err(CliError::failed(
            "the command that starts this program is not known; start `periplus mcp` by its path",
        ));
    }
    let folder = match &options.folder {
        Some(folder) if !folder.is_dir() => {
            return Err(CliError::usage(format!("no folder {}", folder.display())));
        }
        Some(folder) => folder.clone(),
        None => std::env::current_dir().map_err(CliError::failed)?,
    };
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .map_err(CliError::failed)?;
    runtime.block_on(serve(Verbs { tools, folder }))?;
    Ok(ExitCode::SUCCESS)
}

impl McpOptions {
    /// Tools that were asked for, or all.
    fn selected(&self) -> Result<Vec<VerbTool>, CliError> {
        let mut all = tools::all(&help::command());
        if let Some(unknown) =
            self.tools.iter().find(|name| all.iter().all(|tool| tool.name != **name))
        {
            let names: Vec<&str> = all.iter().map(|tool| tool.name.as_str()).collect();
            return Err(CliError::usage(format!(
                "no tool `{unknown}`; there are {}",
                names.join(", ")
            )));
        }
        all.retain(|tool| self.tools.is_empty() || self.tools.contains(&tool.name));
        Ok(all)
    }
}

/// Serves until the client closes standard input.
async fn serve(verbs: Verbs) -> Result<(), CliError> {
    let running = verbs.serve(rmcp::transport::stdio()).await.map_err(|error| {
        CliError::failed(format!("the client did not speak the Model Context Protocol: {error}"))
    })?;
    running.waiting().await.map_err(CliError::failed)?;
    Ok(())
}

/// Commands as tools.
struct Verbs {
    tools: Vec<VerbTool>,
    folder: PathBuf,
}

impl ServerHandler for Verbs {
    fn get_info(&self) -> ServerConfig {
        let name =
            Implementation::new("periplus", env!("CARGO_PKG_VERSION")).with_title("Periplus");
        ServerConfig::new(ServerCapabilities::builder().enable_tools().build())
            .with_server_info(name)
            .with_instructions(INSTRUCTIONS)
    }

    async fn list_tools(
        &self,
        _page: Option<PaginatedRequestParams>,
        _context: RequestContext<RoleServer>,
    ) -> Result<ListToolsResult, ErrorData> {
        Ok(ListToolsResult::with_all_items(self.tools.iter().map(VerbTool::to_tool).collect()))
    }

    fn get_tool(&self, name: &str) -> Option<Tool> {
        self.tools.iter().find(|tool| tool.name == name).map(VerbTool::to_tool)
    }

    async fn call_tool(
        &self,
        request: CallToolRequestParams,
        context: RequestContext<RoleServer>,
    ) -> Result<CallToolResponse, ErrorData> {
        let Some(tool) = self.tools.iter().find(|tool| tool.name == request.name) else {
            return Err(ErrorData::invalid_params(format!("no tool `{}`", request.name), None));
        };
        let arguments = request.arguments.unwrap_or_default();
        let call = match tool.words(&arguments) {
            Ok(call) => call,
            // The model that called the tool reads it and can correct its call.
            Err(reason) => {
                return Ok(
                    CallToolResult::error(vec![rmcp::model::ContentBlock::text(reason)]).into()
                );
            }
        };
        Ok(call::run(&call, &self.folder, &context).await.into())
    }
}
