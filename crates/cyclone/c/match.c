/* Cyclone's `ddsi_endpoint_match.c`, with one question more before a writer takes a reader elsewhere:
   whether the reader's DDS is of the kind that the writer is for. The answers of a service have two
   forms, and a program that gets the other one cannot read it. The sources stay as they are; the
   question is put where DDS Security, which is not built in, would put its own. */
#include <stdbool.h>

#include "ddsi__security_omg.h"

struct ddsi_writer;
struct ddsi_proxy_reader;
bool pp_is_for(const struct ddsi_writer *writer, const struct ddsi_proxy_reader *reader);

#define ddsi_omg_security_match_remote_reader_enabled(writer, reader, relay, handle) \
  (pp_is_for((writer), (reader)) &&                                                  \
   ddsi_omg_security_match_remote_reader_enabled((writer), (reader), (relay), (handle)))
#include "ddsi_endpoint_match.c"
