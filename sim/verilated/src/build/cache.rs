//! One model to one object file, kept from build to build.

use std::fs;
use std::path::{Path, PathBuf};

use super::{runtime, shim, verilator, write, BuildError, ModelSource, Optimisation, Verilator};

/// The object file of the model. Built in a fresh folder unless the folder holds it already, made from the same
/// text with the same tool and options.
pub(super) fn object_of(
    model: &ModelSource,
    verilator: &Verilator,
    folder: &Path,
    package: &str,
) -> Result<PathBuf, BuildError> {
    let class = shim::class_name(package, &model.name);
    let key = key(model, verilator, &class);
    let key_file = folder.join("key");
    let kept = fs::read_to_string(folder.join("object"))
        .map(PathBuf::from)
        .ok()
        .filter(|object| object.is_file());
    if let Some(object) = kept {
        if fs::read_to_string(&key_file).is_ok_and(|kept| kept == key) {
            return Ok(object);
        }
    }
    let failed = |source| BuildError::File {
        path: folder.to_path_buf(),
        source,
    };
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(failed)?;
    }
    fs::create_dir_all(folder).map_err(failed)?;
    verilator.translate(model, &class, folder)?;
    let object = compile(model, verilator, &class, folder)?;
    write(&folder.join("object"), &object.to_string_lossy())?;
    // Last, so that a build that was cut short is not taken for a whole one.
    write(&key_file, &key)?;
    Ok(object)
}

/// Everything the object depends on, in full: equal keys mean equal objects.
fn key(model: &ModelSource, verilator: &Verilator, class: &str) -> String {
    let arguments = verilator::arguments(model, class).join(" ");
    [
        verilator.version(),
        &arguments,
        shim::HEADER,
        &model.verilog,
    ]
    .join("\n")
}

/// All C++ files of the model and its shim as one unit: most of the time goes into headers.
fn compile(
    model: &ModelSource,
    verilator: &Verilator,
    class: &str,
    folder: &Path,
) -> Result<PathBuf, BuildError> {
    let cpp = folder.join("cpp");
    let header = cpp.join(format!("{class}.h"));
    let read = |path: PathBuf| {
        fs::read_to_string(&path).map_err(|source| BuildError::File { path, source })
    };
    let ports = shim::ports(&model.name, &read(header)?)?;
    write(&folder.join("shim.hpp"), shim::HEADER)?;
    let mut unit = String::new();
    for file in cpp_files(&cpp)? {
        unit += &format!("#include \"cpp/{file}\"\n");
    }
    unit += &shim::cpp_unit(class, &model.name, &ports);
    let unit_file = folder.join(format!("{class}_unit.cpp"));
    write(&unit_file, &unit)?;
    let trace = if model.trace { "1" } else { "0" };
    let mut build = runtime::compiler(verilator);
    build
        .opt_level(match model.optimisation {
            Optimisation::Quick => 1,
            Optimisation::Fast => 2,
        })
        .define("VM_TRACE", trace)
        .define("VM_TRACE_VCD", trace)
        .include(folder)
        .include(&cpp)
        .out_dir(folder)
        .file(unit_file);
    let objects = build.try_compile_intermediates()?;
    objects.into_iter().next().ok_or_else(|| BuildError::File {
        path: folder.to_path_buf(),
        source: std::io::ErrorKind::NotFound.into(),
    })
}

/// The C++ files in the folder, by name.
fn cpp_files(folder: &Path) -> Result<Vec<String>, BuildError> {
    let failed = |source| BuildError::File {
        path: folder.to_path_buf(),
        source,
    };
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
