//! Makes of a library for WebAssembly what a page loads, and the script that calls it: its arguments are that library,
//! a folder and a name.

use std::error::Error;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let given: Result<[String; 3], _> = std::env::args().skip(1).collect::<Vec<_>>().try_into();
    let [library, folder, name] = given.map_err(|_| "a library, a folder and a name are required")?;
    let mut bind = Bindgen::new();
    bind.input_path(library).out_name(&name).web(true)?.typescript(false);
    bind.remove_name_section(true).remove_producers_section(true);
    Ok(bind.generate(folder)?)
}
