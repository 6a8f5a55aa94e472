//! `cargo xtask dist`: the files of a release, equal to the byte in every build of the same sources.

mod archive;
mod build;
mod checksums;
mod contents;
mod licenses;
mod npm;
mod packages;
mod sbom;
mod target;
mod tools;
mod twice;
mod wheel;

use std::path::{Path, PathBuf};

pub(crate) use build::{Profile, command as build_command, last_program};
pub(crate) use target::{TARGETS, Target, parse};
pub(crate) use tools::zig;
pub(crate) use wheel::check_in_clean_environments;

use crate::step::{Failed, root, timed};

/// Wish of the caller.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Target triple; repeatable. By default all Linux and Windows targets, or on macOS those of macOS
    #[arg(long = "target", value_name = "TRIPLE", value_parser = parse)]
    targets: Vec<&'static Target>,
    /// Build profile
    #[arg(long, value_enum, default_value_t = Profile::Dist)]
    profile: Profile,
    /// Program of this machine that prints completions and manual pages where that of the target does not run here, in
    /// place of a release build
    #[arg(long, value_name = "FILE")]
    native: Option<PathBuf>,
    /// Output folder
    #[arg(long, value_name = "DIR", default_value = "target/distribution/out")]
    out: PathBuf,
    /// Build the archives a second time from a copy of the sources in another folder, and compare the bytes
    #[arg(long)]
    twice: bool,
    /// Write the bills of materials and the licences of all libraries only, without building
    #[arg(long, conflicts_with_all = ["twice", "wheels", "npm"])]
    texts: bool,
    /// Build Python wheels instead of archives
    #[arg(long, conflicts_with_all = ["twice", "npm"])]
    wheels: bool,
    /// Install the wheel of this machine into clean environments of each installed CPython and use it
    #[arg(long, requires = "wheels")]
    install: bool,
    /// Build the package for npm instead of archives, and test it in node
    #[arg(long, conflicts_with = "twice")]
    npm: bool,
}

/// Builds what the options name, and writes checksums of all files in the output folder.
///
/// # Errors
/// When a tool is missing, a build fails, or two builds differ.
pub(crate) fn run(options: &Options) -> Result<(), Failed> {
    let out = root().join(&options.out);
    make_folder(&out)?;
    if options.npm {
        timed("dist: npm", || npm::pack(&out))?;
        return checksums::write_list(&out);
    }
    let chosen: Vec<&Target> = if options.targets.is_empty() {
        TARGETS.iter().filter(|target| target.is_default()).collect()
    } else {
        options.targets.clone()
    };
    if options.wheels {
        for target in chosen.iter().filter(|target| target.has_wheel()) {
            timed(&format!("dist: wheel for {}", target.triple), || {
                wheel::build(target, &out, options.profile)
            })?;
        }
        if options.install {
            timed("dist: wheel in clean environments", || check_in_clean_environments(&out))?;
        }
        return checksums::write_list(&out);
    }
    if options.texts {
        for target in chosen {
            let name = format!("periplus-{}-{}", version(), target.triple);
            let terms = contents::terms(&root(), target)?;
            write(&out.join(format!("{name}-licenses.txt")), terms.as_bytes())?;
            write_bill(&root(), target, &out)?;
        }
        return checksums::write_list(&out);
    }
    for target in chosen {
        timed(&format!("dist: {}", target.triple), || {
            let native = options.native.as_ref().map(|program| root().join(program));
            let sources = Sources { folder: root(), profile: options.profile, native };
            let archive = archive_of(&sources, target, &out)?;
            if options.twice { twice::compare(target, &sources, &archive) } else { Ok(()) }
        })?;
    }
    checksums::write_list(&out)
}

/// Sources of an archive, and how they are built.
struct Sources {
    folder: PathBuf,
    profile: Profile,
    /// Program that prints completions and manual pages.
    native: Option<PathBuf>,
}

/// Builds the program and packs it; returns the archive.
fn archive_of(sources: &Sources, target: &Target, out: &Path) -> Result<PathBuf, Failed> {
    let program = build::build(&sources.folder, target, sources.profile)?;
    let files = contents::gather(sources, target, &program)?;
    let name = format!("periplus-{}-{}", version(), target.triple);
    let packed = archive::pack(target.archive, &name, &files, build::source_date(&root())?)?;
    let path = out.join(format!("{name}.{}", target.archive.extension()));
    write(&path, &packed)?;
    let program_bytes = std::fs::metadata(&program).map(|it| it.len()).unwrap_or_default();
    println!(
        "{}: program {:.1} MB, archive {:.1} MB, {} files",
        path.display(),
        program_bytes as f64 * 1e-6,
        packed.len() as f64 * 1e-6,
        files.len()
    );
    write_bill(&sources.folder, target, out)?;
    Ok(path)
}

fn write_bill(source: &Path, target: &Target, out: &Path) -> Result<(), Failed> {
    let path = out.join(format!("periplus-{}-{}.cdx.json", version(), target.triple));
    write(&path, sbom::of(source, target)?.as_bytes())
}

/// Version of the workspace, which is that of this tool.
pub(crate) fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

fn make_folder(folder: &Path) -> Result<(), Failed> {
    std::fs::create_dir_all(folder)
        .map_err(|error| Failed(format!("cannot create {}: {error}", folder.display())))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failed> {
    std::fs::write(path, bytes)
        .map_err(|error| Failed(format!("cannot write {}: {error}", path.display())))
}

fn read(path: &Path) -> Result<Vec<u8>, Failed> {
    std::fs::read(path).map_err(|error| Failed(format!("cannot read {}: {error}", path.display())))
}
