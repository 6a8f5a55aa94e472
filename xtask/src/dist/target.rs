//! Targets of a release.

use super::archive::ArchiveFormat;

/// A platform for which programs are built.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Target {
    /// Triple of rustc.
    pub(crate) triple: &'static str,
    pub(super) archive: ArchiveFormat,
    /// Suffix of the triple that names the oldest glibc, for the linker.
    glibc: &'static str,
    /// Platform tag of wheels; empty where none is built.
    wheel_tag: &'static str,
}

/// Oldest glibc of programs and wheels: that of Debian 10, RHEL 8 and Ubuntu 18.10.
const GLIBC: &str = ".2.28";

/// All targets.
pub(crate) const TARGETS: [Target; 7] = [
    linux("x86_64-unknown-linux-gnu", GLIBC, "manylinux_2_28"),
    linux("x86_64-unknown-linux-musl", "", ""),
    linux("aarch64-unknown-linux-gnu", GLIBC, "manylinux_2_28"),
    linux("aarch64-unknown-linux-musl", "", ""),
    Target {
        triple: "x86_64-pc-windows-gnu",
        archive: ArchiveFormat::Zip,
        glibc: "",
        wheel_tag: "",
    },
    linux("aarch64-apple-darwin", "", ""),
    linux("x86_64-apple-darwin", "", ""),
];

const fn linux(triple: &'static str, glibc: &'static str, wheel_tag: &'static str) -> Target {
    Target { triple, archive: ArchiveFormat::TarGz, glibc, wheel_tag }
}

impl Target {
    /// True if the target is built when none is named.
    pub(super) fn is_default(&self) -> bool {
        self.is_apple() == cfg!(target_os = "macos")
    }

    pub(crate) fn is_apple(&self) -> bool {
        self.triple.ends_with("-apple-darwin")
    }

    pub(crate) fn is_windows(&self) -> bool {
        self.triple.contains("-windows-")
    }

    pub(super) fn has_wheel(&self) -> bool {
        !self.wheel_tag.is_empty()
    }

    /// Platform tag of wheels.
    pub(super) fn wheel_tag(&self) -> &'static str {
        self.wheel_tag
    }

    /// Triple with the oldest glibc, as cargo-zigbuild reads it.
    pub(super) fn linker_triple(&self) -> String {
        format!("{}{}", self.triple, self.glibc)
    }

    /// File name of a program.
    pub(crate) fn executable(&self, name: &str) -> String {
        if self.is_windows() { format!("{name}.exe") } else { name.to_owned() }
    }

    /// True if programs of the target run on this machine without an emulator.
    pub(crate) fn is_native(&self) -> bool {
        let system = if cfg!(target_os = "macos") { "-apple-darwin" } else { "-unknown-linux-" };
        self.triple.starts_with(std::env::consts::ARCH) && self.triple.contains(system)
    }
}

/// Returns the target of a triple.
pub(crate) fn parse(triple: &str) -> Result<&'static Target, String> {
    TARGETS.iter().find(|target| target.triple == triple).ok_or_else(|| {
        let known: Vec<&str> = TARGETS.iter().map(|target| target.triple).collect();
        format!("targets are {}", known.join(", "))
    })
}

#[test]
fn the_linker_gets_the_oldest_glibc() {
    let of = |triple| parse(triple).map(Target::linker_triple);
    assert_eq!(of("aarch64-unknown-linux-gnu").as_deref(), Ok("aarch64-unknown-linux-gnu.2.28"));
    assert_eq!(of("x86_64-unknown-linux-musl").as_deref(), Ok("x86_64-unknown-linux-musl"));
    assert!(of("x86_64-pc-windows-msvc").is_err());
}
