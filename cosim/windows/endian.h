/* The order of bytes as musl's functions ask for it, which mingw-w64 has no header for. */
#ifndef POLYNYA_WINDOWS_ENDIAN_H
#define POLYNYA_WINDOWS_ENDIAN_H

#define __LITTLE_ENDIAN __ORDER_LITTLE_ENDIAN__
#define __BIG_ENDIAN __ORDER_BIG_ENDIAN__
#define __BYTE_ORDER __BYTE_ORDER__

#endif
