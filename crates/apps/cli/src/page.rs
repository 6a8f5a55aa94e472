//! Options of the page.

use std::net::{IpAddr, SocketAddr};
use std::path::Path;

use clap::Args;
use periplus_session::page::{DEFAULT_PORT, default_address};
use periplus_session::{PageContext, PageSettings};
use periplus_web::foxglove::JobError;

use crate::report::report_html;

/// Options of the page.
#[derive(Debug, Default, Args)]
pub(crate) struct PageOptions {
    /// Serve the page at 127.0.0.1:8765 or at another address; Lichtblick and Foxglove connect
    /// there too
    #[arg(
        long,
        value_name = "ADDRESS:PORT",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "127.0.0.1",
        value_parser = address
    )]
    pub(crate) page: Option<SocketAddr>,
    /// Token that admits other machines and pages from elsewhere [default: a new one if other
    /// machines reach the address]
    #[arg(long, value_name = "TOKEN", requires = "page")]
    pub(crate) token: Option<String>,
}

impl PageOptions {
    /// Settings of a page that is served in any case, by default on this machine.
    pub(crate) fn settings(&self, context: PageContext) -> PageSettings {
        let context = PageContext { report: Some(report), ..context };
        let address = self.page.unwrap_or_else(default_address);
        PageSettings::at(address, self.token.clone(), context)
    }

    /// Settings of the page of a run; none unless it is requested.
    pub(crate) fn of_run(
        &self,
        context: PageContext,
        is_quiet: bool,
        opens_browser: bool,
    ) -> Option<PageSettings> {
        self.page?;
        Some(PageSettings { is_quiet, opens_browser, ..self.settings(context) })
    }
}

/// Writes the reports that the page offers.
fn report(paths: &[&Path]) -> Result<String, JobError> {
    report_html(paths).map_err(|error| JobError::Failed(error.to_string()))
}

/// Parses `ADDRESS:PORT`, one of them, or `localhost`.
fn address(word: &str) -> Result<SocketAddr, String> {
    let loopback = IpAddr::from([127, 0, 0, 1]);
    let named = word.replacen("localhost", "127.0.0.1", 1);
    if let Ok(address) = named.parse::<SocketAddr>() {
        return Ok(address);
    }
    if let Ok(port) = named.parse::<u16>() {
        return Ok(SocketAddr::new(loopback, port));
    }
    let bare = named.trim_start_matches('[').trim_end_matches(']');
    match bare.parse::<IpAddr>() {
        Ok(ip) => Ok(SocketAddr::new(ip, DEFAULT_PORT)),
        Err(_) => Err("expected an address of this machine, a port, or both: \
                       127.0.0.1:8765; 0.0.0.0 opens it to others"
            .into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_an_address_is_enough() {
        let check = |word: &str, expected: &str| {
            assert_eq!(address(word).map(|one| one.to_string()).as_deref(), Ok(expected));
        };
        check("8766", "127.0.0.1:8766");
        check("localhost", "127.0.0.1:8765");
        check("localhost:1", "127.0.0.1:1");
        check("0.0.0.0", "0.0.0.0:8765");
        check("[::1]:9", "[::1]:9");
        check("::1", "[::1]:8765");
        assert!(address("robot").is_err() && address("99999").is_err());
    }
}
