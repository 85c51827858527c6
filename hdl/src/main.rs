fn main() {
    let c = incircle_protocol::Config::named(&std::env::args().nth(1).unwrap()).unwrap();
    match incircle_hdl::export::core(c, std::env::args().nth(2).is_some()) {
        Ok(t) => print!("{t}"),
        Err(e) => {
            eprintln!("{e}");
            std::process::exit(1)
        }
    }
}
