//! This program: version, target, profile, and what is built in.

use std::env::consts::{ARCH, OS};

use serde_json::{Value, json};

use super::SelfCheck;

/// Build profile, which `cargo xtask dist` sets.
const PROFILE: Option<&str> = option_env!("PERIPLUS_BUILD_PROFILE");

/// Commit of the sources, which `cargo xtask dist` sets.
const COMMIT: Option<&str> = option_env!("PERIPLUS_BUILD_COMMIT");

/// Triple of the target, such as `x86_64-unknown-linux-musl`.
pub(super) fn target() -> String {
    let vendor_and_system = match OS {
        "linux" => "unknown-linux",
        "windows" => "pc-windows",
        "macos" => return format!("{ARCH}-apple-darwin"),
        other => other,
    };
    let environment = if cfg!(target_env = "musl") {
        "musl"
    } else if cfg!(target_env = "msvc") {
        "msvc"
    } else {
        "gnu"
    };
    format!("{ARCH}-{vendor_and_system}-{environment}")
}

/// Profile, as far as it is known without [`PROFILE`].
fn profile() -> &'static str {
    PROFILE.unwrap_or(if cfg!(debug_assertions) { "debug" } else { "release" })
}

/// Optional features that are compiled in.
fn features() -> Vec<&'static str> {
    if cfg!(feature = "zenoh") { vec!["zenoh"] } else { Vec::new() }
}

pub(super) fn identity() -> Value {
    let (files, bytes) = periplus_web::server::embedded_page();
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "target": target(),
        "profile": profile(),
        "commit": COMMIT,
        "features": features(),
        "page": { "files": files, "bytes": bytes },
    })
}

pub(super) fn build() -> SelfCheck {
    let features = features();
    let features =
        if features.is_empty() { "no optional features".to_owned() } else { features.join(", ") };
    let commit = COMMIT.map(|commit| format!(", commit {commit}")).unwrap_or_default();
    let found = format!(
        "periplus {} for {}, profile {}{commit}, {features}",
        env!("CARGO_PKG_VERSION"),
        target(),
        profile()
    );
    if cfg!(debug_assertions) {
        let advice = "build with `cargo build --release`, which is many times faster";
        return SelfCheck::warning("program", found, advice);
    }
    SelfCheck::ok("program", found)
}

pub(super) fn page() -> SelfCheck {
    let (files, bytes) = periplus_web::server::embedded_page();
    if files == 0 {
        let advice = "build it with `cargo xtask viewer build`, then build the program again";
        return SelfCheck::error("page", "not in this program", advice);
    }
    SelfCheck::ok("page", format!("built in: {files} files, {} kB", bytes / 1000))
}

pub(super) fn python() -> SelfCheck {
    match crate::own_command::interpreter().command() {
        Ok(command) => SelfCheck::ok("Python", format!("`{command}` has the package `periplus`")),
        Err(why) => SelfCheck::warning(
            "Python",
            "no interpreter with the package `periplus`: nodes in Python do not run",
            why.to_string(),
        ),
    }
}

#[test]
fn the_target_is_that_of_the_compiler() {
    let target = target();
    assert!(target.starts_with(ARCH), "{target}");
    assert_eq!(target.contains("linux"), cfg!(target_os = "linux"));
    assert_eq!(target.ends_with("-musl"), cfg!(target_env = "musl"));
}
