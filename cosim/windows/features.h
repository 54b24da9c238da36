/* Empty: musl's tables include this header of its C library, of which they use nothing. */
