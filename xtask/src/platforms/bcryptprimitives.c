/* The one function of bcryptprimitives.dll that Rust's standard library imports, for versions of Wine without it. */
#include <windows.h>

/* RtlGenRandom by its name in advapi32.dll. */
BOOLEAN NTAPI SystemFunction036(PVOID bytes, ULONG length);

__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE bytes, SIZE_T length) {
    return SystemFunction036(bytes, (ULONG)length);
}
