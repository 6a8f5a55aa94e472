/* Cyclone's `ddsi_endpoint_match.c`, with one question more before a writer takes a reader elsewhere:
   whether the reader's DDS is of the kind that the writer is for. The answers of a service have two
   forms, and a program that gets the other one cannot read it. The sources stay as they are; the
   question is put where DDS Security, which is not built in, would put its own.

   And a reader asks writers of Fast DDS for all that they sent since they know of it, not only writers
   of Cyclone DDS. Who is found first is written to first: what comes before its writer is known here is
   dropped, and Cyclone lets a volatile reader of another vendor's writer begin with the newest sample,
   so that it was never asked for again. Fast DDS, like Cyclone, holds back what is older than the
   match (`ReaderProxy` there: a volatile reader gets GAPs for it). It is the only place in this file
   where the vendor matters. */
#include <stdbool.h>

#include "ddsi__vendor.h"

#include "ddsi__security_omg.h"

struct ddsi_writer;
struct ddsi_proxy_reader;
bool pp_is_for(const struct ddsi_writer *writer, const struct ddsi_proxy_reader *reader);

#define ddsi_omg_security_match_remote_reader_enabled(writer, reader, relay, handle) \
  (pp_is_for((writer), (reader)) &&                                                  \
   ddsi_omg_security_match_remote_reader_enabled((writer), (reader), (relay), (handle)))
#define ddsi_vendor_is_eclipse(vendor) (ddsi_vendor_is_eclipse (vendor) || ddsi_vendor_is_eprosima (vendor))
#include "ddsi_endpoint_match.c"
