//! Gives the shared library a name with the number of its interface, so that a program finds one that it can use.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux") {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libincircle_c.so.1");
    }
}
