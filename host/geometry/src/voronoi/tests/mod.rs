mod brute;
mod holes;
