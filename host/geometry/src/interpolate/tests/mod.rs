mod brute;
