//! Compiles Cyclone DDS from the sources in the crate `cyclonedds-src`, and our shim in `c`.
//!
//! Only the core is built: no security, no TLS, no shared memory, no IDL compiler. The C code is
//! optimized in every profile, since tests depend on its speed.
#![allow(clippy::disallowed_methods, reason = "cargo passes settings to build scripts this way")]

use std::env;
use std::path::Path;

/// Version that the shim was written for; another version has to be reviewed.
const VERSION: &str = "project(CycloneDDS VERSION 11.0.0";

/// `src/ddsrt/src`: platform-independent files.
const RUNTIME: &[&str] = &[
    "atomics",
    "avl",
    "bits",
    "bswap",
    "cdtors",
    "circlist",
    "dynlib",
    "environ",
    "expand_vars",
    "fibheap",
    "hopscotch",
    "ifaddrs",
    "io",
    "log",
    "machineid",
    "md5",
    "mh3",
    "random",
    "retcode",
    "sockets",
    "strtod",
    "string",
    "strtol",
    "threads",
    "time",
    "xmlparser",
    "heap/posix/heap",
];

/// `src/ddsrt/src`: platform-dependent files; the folder name is inserted.
const RUNTIME_OF_SYSTEM: &[&str] =
    &["dynlib", "environ", "filesystem", "process", "random", "sync", "threads", "ifaddrs"];

/// `src/core/ddsi/src`: the protocol, without the files that `c/acknack.c`, `c/match.c`,
/// `c/transmit.c` and `c/udp.c` replace.
const PROTOCOL: &[&str] = &[
    "ddsi_addrset",
    "ddsi_bitset",
    "ddsi_bswap",
    "ddsi_config",
    "ddsi_deadline",
    "ddsi_debmon",
    "ddsi_deliver_locally",
    "ddsi_discovery",
    "ddsi_discovery_addrset",
    "ddsi_discovery_endpoint",
    "ddsi_discovery_spdp",
    "ddsi_endpoint",
    "ddsi_entity",
    "ddsi_entity_index",
    "ddsi_eth",
    "ddsi_freelist",
    "ddsi_gc",
    "ddsi_guid",
    "ddsi_handshake",
    "ddsi_hbcontrol",
    "ddsi_iid",
    "ddsi_init",
    "ddsi_inverse_uint32_set",
    "ddsi_ipaddr",
    "ddsi_lat_estim",
    "ddsi_lease",
    "ddsi_lifespan",
    "ddsi_list_genptr",
    "ddsi_mcgroup",
    "ddsi_misc",
    "ddsi_nwinterfaces",
    "ddsi_nwpart",
    "ddsi_participant",
    "ddsi_pcap",
    "ddsi_plist",
    "ddsi_pmd",
    "ddsi_portmapping",
    "ddsi_proxy_endpoint",
    "ddsi_proxy_participant",
    "ddsi_qosmatch",
    "ddsi_radmin",
    "ddsi_raweth",
    "ddsi_receive",
    "ddsi_rhc",
    "ddsi_security_omg",
    "ddsi_security_util",
    "ddsi_serdata",
    "ddsi_serdata_cdr",
    "ddsi_serdata_plist",
    "ddsi_serdata_pserop",
    "ddsi_sertype",
    "ddsi_sertype_cdr",
    "ddsi_sertype_plist",
    "ddsi_sertype_pserop",
    "ddsi_sockwaitset",
    "ddsi_spdp_schedule",
    "ddsi_ssl",
    "ddsi_statistics",
    "ddsi_sysdeps",
    "ddsi_tcp",
    "ddsi_thread",
    "ddsi_threadmon",
    "ddsi_time",
    "ddsi_tkmap",
    "ddsi_topic",
    "ddsi_tran",
    "ddsi_vendor",
    "ddsi_vnet",
    "ddsi_whc",
    "ddsi_wraddrset",
    "ddsi_xevent",
    "ddsi_xmsg",
];

/// `src/core/ddsc/src`: the API.
const INTERFACE: &[&str] = &[
    "dds_alloc",
    "dds_builtin",
    "dds_coherent",
    "dds_domain",
    "dds_entity",
    "dds_err_check",
    "dds_guardcond",
    "dds_guid",
    "dds_handles",
    "dds_heap_loan",
    "dds_init",
    "dds_instance",
    "dds_listener",
    "dds_loaned_sample",
    "dds_matched",
    "dds_participant",
    "dds_psmx",
    "dds_publisher",
    "dds_qos",
    "dds_querycond",
    "dds_read",
    "dds_readcond",
    "dds_reader",
    "dds_rhc",
    "dds_rhc_default",
    "dds_serdata_builtintopic",
    "dds_serdata_default",
    "dds_sertype_builtintopic",
    "dds_sertype_default",
    "dds_statistics",
    "dds_subscriber",
    "dds_topic",
    "dds_waitset",
    "dds_whc",
    "dds_whc_builtintopic",
    "dds_write",
    "dds_writer",
];

fn main() {
    println!("cargo:rerun-if-changed=c");
    println!("cargo:rerun-if-changed=build.rs");
    let source = cyclonedds_src::source_dir();
    let listed = std::fs::read_to_string(source.join("CMakeLists.txt")).unwrap_or_default();
    assert!(
        listed.contains(VERSION),
        "the sources of Cyclone DDS in {} are not those of `{VERSION}`; compare c/*.c with the new \
         ones and change build.rs and c/include/dds/version.h",
        source.display()
    );
    let target = env::var("CARGO_CFG_TARGET_OS").unwrap_or_default();
    let (runtime, core) = (source.join("src/ddsrt"), source.join("src/core"));

    let mut build = cc::Build::new();
    build
        .include("c/include")
        .include("c")
        .include(runtime.join("include"))
        .include(runtime.join("src"))
        .include(core.join("ddsc/include"))
        .include(core.join("ddsc/src"))
        .include(core.join("ddsi/include"))
        .include(core.join("ddsi/src"))
        .include(core.join("cdr/include"))
        .include(source.join("src/security/api/include"))
        .opt_level(2)
        .debug(false)
        .define("NDEBUG", None)
        .warnings(false)
        .flag_if_supported("-std=gnu11")
        .flag_if_supported("-fno-common")
        .flag_if_supported("-fno-strict-aliasing");
    let mut add = |folder: &Path, names: &[&str]| {
        for name in names {
            build.file(folder.join(name).with_extension("c"));
        }
    };
    add(&runtime.join("src"), RUNTIME);
    add(&runtime.join("src"), &of_system(&target));
    add(&core.join("ddsi/src"), PROTOCOL);
    add(&core.join("ddsi"), &["defconfig"]);
    add(&core.join("ddsc/src"), INTERFACE);
    add(&core.join("cdr/src"), &["dds_cdrstream"]);
    add(Path::new("c"), &["acknack", "blob", "match", "shim", "transmit", "udp"]);
    build.compile("periplus_cyclonedds_sys");

    if target == "windows" {
        for library in ["ws2_32", "iphlpapi", "bcrypt", "dbghelp"] {
            println!("cargo:rustc-link-lib={library}");
        }
    }
}

fn of_system(target: &str) -> Vec<&'static str> {
    let (family, clock, netstat) = match target {
        "windows" => ("windows", "windows", "windows"),
        "macos" | "ios" => ("posix", "darwin", "darwin"),
        _ => ("posix", "posix", "linux"),
    };
    let named = |folder: &str, system: &str, name: &str| -> &'static str {
        Box::leak(format!("{folder}/{system}/{name}").into_boxed_str())
    };
    let mut all: Vec<_> = RUNTIME_OF_SYSTEM.iter().map(|part| named(part, family, part)).collect();
    all.push(named("sockets", family, "socket"));
    all.push(named("sockets", family, "gethostname"));
    all.push(named("time", clock, "time"));
    all.push(named("netstat", netstat, "netstat"));
    all.push(named("rusage", family, "rusage"));
    all
}
