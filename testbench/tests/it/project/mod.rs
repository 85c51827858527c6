//! What holds for the project as a whole: who may use whom, what may import what, and the documents.

mod dependencies;
mod documents;
mod glossary;
mod import_circles;
mod mirror;
mod rules;
