//! Tests of the project as a whole: which package may use which, which module may import which, and the documents.

mod dependencies;
mod documents;
mod glossary;
mod import_circles;
mod licences;
mod manifests;
mod mirror;
mod public_api;
mod rules;
