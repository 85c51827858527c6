//! From a model to its object files, which are kept from build to build.

use std::fs;
use std::path::{Path, PathBuf};

use super::error::BuildError;
use super::file::write;
use super::source::{ModelSource, Optimisation};
use super::verilator::Verilator;
use super::{rewrite, runtime, shim, verilator};

/// The object files of the model. The folder's objects are taken if they were made from the same text with the same
/// tools and options; otherwise the folder is emptied and the model is built in it.
pub(super) fn objects_of(
    model: &ModelSource,
    verilator: &Verilator,
    compiler: &str,
    folder: &Path,
    package: &str,
) -> Result<Vec<PathBuf>, BuildError> {
    let model = &ModelSource { verilog: rewrite::rewritten(model)?, ..model.clone() };
    let class = shim::class_name(package, &model.name);
    let key = key(model, verilator, compiler, &class);
    let key_file = folder.join("key");
    let list_file = folder.join("objects");
    if fs::read_to_string(&key_file).is_ok_and(|kept| kept == key) {
        let list = fs::read_to_string(&list_file).unwrap_or_default();
        let objects: Vec<PathBuf> = list.lines().map(PathBuf::from).collect();
        if !objects.is_empty() && objects.iter().all(|object| object.is_file()) {
            return Ok(objects);
        }
    }
    let failed = |source| BuildError::File { path: folder.to_path_buf(), source };
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(failed)?;
    }
    fs::create_dir_all(folder).map_err(failed)?;
    verilator.translate(model, &class, folder)?;
    let objects = compile(model, verilator, &class, folder)?;
    let list: Vec<_> = objects.iter().map(|object| object.to_string_lossy()).collect();
    write(&list_file, &list.join("\n"))?;
    // The key is written last, so that an interrupted build is not mistaken for a complete one.
    write(&key_file, &key)?;
    Ok(objects)
}

/// Everything on which the objects depend, in full: equal keys mean equal objects.
fn key(model: &ModelSource, verilator: &Verilator, compiler: &str, class: &str) -> String {
    let arguments = verilator::arguments(model, class).join(" ");
    let optimisation = format!("{:?} {}", model.optimisation, model.fast_clocks);
    [verilator.version(), compiler, &arguments, &optimisation, shim::HEADER, &model.verilog].join("\n")
}

/// Compiles the C++ of the model and its shim in as few units as is sensible, because headers take most
/// of a unit's time.
fn compile(model: &ModelSource, verilator: &Verilator, class: &str, folder: &Path) -> Result<Vec<PathBuf>, BuildError> {
    let cpp = folder.join("cpp");
    let path = cpp.join(format!("{class}.h"));
    let header = fs::read_to_string(&path).map_err(|source| BuildError::File { path, source })?;
    let shim = shim::cpp_unit(class, &model.name, &shim::ports(&model.name, &header)?);
    write(&folder.join("shim.hpp"), shim::HEADER)?;
    let trace = if model.trace { "1" } else { "0" };
    let mut compiler = runtime::compiler(verilator);
    compiler.define("VM_TRACE", trace).define("VM_TRACE_VCD", trace).include(folder).include(&cpp).out_dir(folder);
    let files = cpp_files(&cpp)?;
    let unit = |name: &str, level: u32, files: &[&String], shim: &str| {
        let include = |file: &&String| format!("#include \"cpp/{file}\"\n");
        let includes: String = files.iter().map(include).collect();
        let file = folder.join(format!("{class}_{name}.cpp"));
        write(&file, &(includes + shim))?;
        let mut compiler = compiler.clone();
        compiler.opt_level(level).file(file);
        Ok::<_, BuildError>(compiler.try_compile_intermediates()?)
    };
    match model.optimisation {
        Optimisation::Quick => unit("all", 1, &files.iter().collect::<Vec<_>>(), &shim),
        Optimisation::Fast => {
            let (seldom, often): (Vec<_>, Vec<_>) = files.iter().partition(|file| is_seldom(file));
            let level = if model.fast_clocks { 3 } else { 2 };
            let mut objects = unit("often", level, &often, &shim)?;
            objects.extend(unit("seldom", 0, &seldom, "")?);
            Ok(objects)
        }
    }
}

/// Whether the file holds code that runs only once or only while tracing: construction, symbols, traces. Most of the
/// code is of this kind.
fn is_seldom(file: &str) -> bool {
    ["Slow", "__Trace__", "__Syms"].iter().any(|part| file.contains(part))
}

/// The C++ files in the folder, sorted by name.
fn cpp_files(folder: &Path) -> Result<Vec<String>, BuildError> {
    let failed = |source| BuildError::File { path: folder.to_path_buf(), source };
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let name = entry.map_err(failed)?.file_name();
        let name = name.to_string_lossy().into_owned();
        if name.ends_with(".cpp") {
            files.push(name);
        }
    }
    files.sort();
    Ok(files)
}
